#include <algorithm>
#include <cmath>
#include <limits>

#include "access.hpp"
#include "body_set.hpp"
#include "cablenet/bodies/rigid_body.hpp"
#include "cablenet/elements/cable.hpp"
#include "cablenet/system/assembler.hpp"
#include "element_loop.hpp"

namespace cablenet::system {
namespace {

double square(double value) { return value * value; }

}   // namespace

double ForceScales::rounding(double furthest, double shift_a) const {
  return std::numeric_limits<double>::epsilon() * (furthest * (stiffness + shift_a * mass) + bed);
}

const LocalState& Assembler::observe(double t, Vec x, Vec v, Vec a) {
  state_.t = t;
  for (auto* field : {&state_.x, &state_.v, &state_.a}) field->resize(3 * at(network_.nodes));
  Access access(*this, x, v, a, nullptr);
  evaluated_ = {};
  access.begin_exchange();
  access.finish_exchange();
  bodies_->place({t, 0, 0}, false, access.data, nullptr);
  const AnyNodes nodes{access.data};
  for (LocalNode i(0); i.value() < network_.nodes; ++i) {
    LocalState::at(state_.x, i) = Eigen::Map<const Vector3>(nodes.x(i));
    LocalState::at(state_.v, i) = Eigen::Map<const Vector3>(nodes.v(i));
    LocalState::at(state_.a, i) = Eigen::Map<const Vector3>(nodes.a(i));
  }
  for (const auto& [node, motion] : network_.prescribed) {
    const scene::Kinematics k = motion.at(t);
    LocalState::at(state_.x, node) = k.x;
    LocalState::at(state_.v, node) = k.v;
    LocalState::at(state_.a, node) = k.a;
  }
  state_.bodies.clear();
  for (std::size_t b = 0; b < network_.bodies.size(); ++b) {
    const bodies::Properties& body = network_.bodies[b].properties;
    const bodies::RotationState rotation = bodies_->rotation(b, access.data);
    state_.bodies.push_back({bodies::attitude(body, rotation.y), bodies::angular_velocity(body.rotation, rotation)});
  }
  return state_;
}

Energies Assembler::energies() const {
  Energies sum;
  for_each_element(network_, {0, network_.own_elements}, [&](std::size_t, const partition::LocalElement& e) {
    const elements::CableMaterial& material = network_.materials[at(e.material)];
    const auto v1 = LocalState::at(state_.v, e.node[0]);
    const auto v2 = LocalState::at(state_.v, e.node[1]);
    const double height = 0.5 * (state_.x[3 * at(e.node[0]) + 2] + state_.x[3 * at(e.node[1]) + 2]);
    sum.kinetic += elements::cable_kinetic_energy(material, e.length, v1, v2);
    sum.strain += elements::cable_strain_energy(material, e.length, state_.chord(e).d);
    sum.gravity += material.mass_per_length * e.length * network_.gravity * height;
    return true;
  });
  sum.work = work_;
  for (int b = 0; b < network_.own_bodies; ++b) {
    const Vector3& w = state_.bodies[at(b)].w;
    const partition::LocalBody& body = network_.bodies[at(b)];
    sum.kinetic += 0.5 * w.dot(body.properties.inertia * w);
    // The energy of the water around things is nowhere counted.
    if (body.water) sum.kinetic -= 0.5 * body.water->added_inertia.dot(w.cwiseAbs2());
  }
  for (int i = 0; i < network_.own_links; ++i) {
    const auto& [node, stiffness] = network_.links[at(i)];
    sum.strain +=
        0.5 * stiffness * (LocalState::at(state_.x, node[1]) - LocalState::at(state_.x, node[0])).squaredNorm();
  }
  for (const auto& [node, mass, force] : network_.loads) {
    const auto x = LocalState::at(state_.x, node);
    sum.kinetic += 0.5 * mass * LocalState::at(state_.v, node).squaredNorm();
    sum.gravity += mass * network_.gravity * x.z();
    sum.work += force.dot(x - network_.position[node]);
  }
  return sum;
}

ForceScales Assembler::force_scales() {
  double load = 0, stiffness = 0, mass = 0, bed = 0;
  for_each_element(network_, {0, network_.own_elements}, [&](std::size_t, const partition::LocalElement& e) {
    const elements::CableMaterial& material = network_.materials[at(e.material)];
    const double m = material.mass_per_length * e.length;
    const Vector3 &v1 = network_.velocity[e.node[0]], &v2 = network_.velocity[e.node[1]];
    const double speed = std::max(v1.norm(), v2.norm());
    const Vector3 d = network_.position[e.node[1]] - network_.position[e.node[0]];
    const double tension = elements::cable_tension(material, e.length, {d, v2 - v1});
    load += square(tension) + square(m * network_.gravity) + square(m * speed * speed / e.length);
    stiffness += square(2 * material.axial_stiffness / e.length);
    mass += square(m);
    if (const auto& on = network_.surroundings.bed)
      bed += square(on->level * on->stiffness * network_.surroundings.on_bed[at(e.material)].diameter * e.length);
    return true;
  });
  for (const auto& item : network_.loads) {
    load += square(item.mass * network_.gravity) + item.force.squaredNorm();
    mass += square(item.mass);
  }
  for (int b = 0; b < network_.own_bodies; ++b) {
    const partition::LocalBody& body = network_.bodies[at(b)];
    const Matrix3& inertia = body.properties.inertia;
    const Vector3 w = bodies::angular_velocity(body.properties.rotation, body.start);
    load += square(2 * w.norm() * (inertia * w).norm()) + square(2 * body.properties.torque.norm());
    mass += square(4 * inertia.norm());
  }
  for (int i = 0; i < network_.own_links; ++i) stiffness += square(2 * network_.links[at(i)].stiffness);
  double sums[] = {load, stiffness, mass, bed};
  MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, communicator_);
  return {std::sqrt(sums[0]), std::sqrt(sums[1]), std::sqrt(sums[2]), std::sqrt(sums[3])};
}

}   // namespace cablenet::system

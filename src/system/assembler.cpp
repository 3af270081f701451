#include "cablenet/system/assembler.hpp"

#include <algorithm>
#include <type_traits>

#include "access.hpp"
#include "body_set.hpp"
#include "cablenet/bodies/rigid_body.hpp"
#include "cablenet/petsc/object_state.hpp"
#include "cablenet/petsc/phase.hpp"
#include "element_loop.hpp"
#include "sweep.hpp"

namespace cablenet::system {
namespace {

using petsc::check;

Eigen::Map<Vector3> as_vector(double* values) { return Eigen::Map<Vector3>(values); }

}   // namespace

Assembler::Assembler(partition::LocalNetwork network, ForceRule rule, MPI_Comm communicator)
    : network_(std::move(network)),
      rule_(rule),
      communicator_(communicator),
      is_elastic_(std::all_of(network_.materials.begin(), network_.materials.end(), elements::is_elastic)),
      ghosts_(network_, communicator),
      starts_(std::make_unique<Starts>()),
      bodies_(std::make_unique<BodySet>(network_, !is_elastic_ || !network_.surroundings.empty())) {
  petsc::register_phases();
  outside_.resize(at(network_.nodes - network_.owned));
  outside_r_.resize(3 * outside_.size());
  ghost_rotations_.resize(at(network_.ghosts));
  prescribed_.resize(network_.prescribed.size());
}

Assembler::~Assembler() = default;

Vector Assembler::make_vector() const {
  Vector vector;
  check(VecCreate(communicator_, vector.out()));
  check(VecSetSizes(vector, network_.unknowns(), network_.all_unknowns()));
  if (network_.blocks.uniform()) check(VecSetBlockSize(vector, 3));
  check(VecSetFromOptions(vector));
  return vector;
}

TangentMatrix Assembler::make_tangent() const {
  const bool rates = std::any_of(network_.materials.begin(), network_.materials.end(),
                                 [](const auto& material) { return material.axial_damping > 0; });
  const bool two_ended = rule_.scheme == scene::Scheme::energy_momentum;
  const bool dry = network_.surroundings.empty();
  const bool nodes_alone = rule_.tangent == elements::Tangent::secant || (!two_ended && !rates);
  const bool symmetric = nodes_alone && dry && network_.blocks.uniform();
  return {network_, symmetric, communicator_};
}

void Assembler::fill_initial(Vec x, Vec v) const {
  for (const auto& [vector, values] : {std::pair{x, &network_.position}, std::pair{v, &network_.velocity}}) {
    double* array = nullptr;
    check(VecGetArrayWrite(vector, &array));
    for (LocalNode node(0); network_.is_owned(node); ++node)
      as_vector(array + network_.begin[node].value()) = (*values)[node];
    for (int b = 0; b < network_.own_bodies; ++b) {
      const partition::LocalBody& body = network_.bodies[at(b)];
      const bodies::Vector4& rotation = vector == x ? body.start.y : body.start.dy;
      const int unknowns = bodies::rotation_unknowns(body.properties.rotation);
      std::copy_n(rotation.data(), unknowns, array + network_.begin[body.node].value() + 3);
    }
    check(VecRestoreArrayWrite(vector, &array));
  }
}

template <class Visit>
void Assembler::visit_law(const Stage& stage, Visit&& visit) const {
  const auto choose = [&]<bool general>() {
    switch (rule_.scheme) {
      case scene::Scheme::energy_momentum:
        return visit(EnergyMomentumLaw<general>{rule_.tangent, stage.alpha_f, stage.dt, rule_.axial_dissipation});
      case scene::Scheme::generalized_alpha:
        return visit(AveragedLaw<general>{{rule_.tangent}, stage.alpha_f});
      case scene::Scheme::plain:
        return visit(StageLaw<general>{rule_.tangent});
    }
  };
  is_elastic_ ? choose.template operator()<false>() : choose.template operator()<true>();
}

void Assembler::begin_step(double t, Vec x, Vec v) {
  Access access(*this, x, v, nullptr, nullptr);
  evaluated_ = {};
  access.begin_exchange();
  start_prescribed(t);
  for (std::size_t i = 0; i < prescribed_.size(); ++i) {
    NodeMotion& here = outside_[at(network_.prescribed[i].node.value() - network_.owned)];
    as_vector(here.x) = prescribed_[i].start.x;
    as_vector(here.v) = prescribed_[i].start.v;
  }
  access.finish_exchange();
  bodies_->begin_step(access.data);
  visit_law({}, [&](const auto& law) { record_starts(law, access); });
}

void Assembler::add_loads(double t, Access& access, const TangentRequest* request) {
  const AnyNodes nodes{access.data};
  if (access.has_residual())
    for (const auto& [node, mass, force] : network_.loads)
      as_vector(nodes.r(node)) +=
          mass * (Eigen::Map<const Vector3>(nodes.a(node)) + Vector3(0, 0, network_.gravity)) - force;
  if (request != nullptr) request->matrix.open();
  if (!network_.wet_points.empty()) add_wet_points(t, access, request);
  if (request == nullptr) return;
  const TangentTarget target{request->matrix.values(), nullptr, 0, 0};
  for (std::size_t i = 0; i < network_.loads.size(); ++i)
    put_block<AnyNodes>(target, request->matrix.load_slots()[i], 0, Matrix3::Zero(),
                        network_.loads[i].mass * request->shift_a);
  request->matrix.close();
}

bool Assembler::residual(const Stage& stage, Vec x, Vec v, Vec a, Vec r, const TangentRequest* request) {
  coincident_ = -1;
  evaluated_ = petsc::state_of(x);
  evaluated_stage_ = stage;
  Access access(*this, x, v, a, r);
  access.begin_exchange();
  set_prescribed(stage);
  bool in_domain = true;
  visit_law(stage, [&](const auto& law) { in_domain = run(law, stage, access, request); });
  add_loads(stage.t + stage.alpha_f * stage.dt, access, request);
  return in_domain;
}

void Assembler::tangent(const Stage& stage, Vec x, Vec v, Vec a, const TangentRequest& request) {
  Access access(*this, x, v, a, nullptr);
  if (petsc::state_of(x) != evaluated_ || stage != evaluated_stage_) {
    access.begin_exchange();
    set_prescribed(stage);
    evaluated_ = petsc::state_of(x);
    evaluated_stage_ = stage;
  }
  visit_law(stage, [&](const auto& law) { run(law, stage, access, &request); });
  add_loads(stage.t + stage.alpha_f * stage.dt, access, &request);
}

void Assembler::mass_matrix(double t, Vec x, Vec v, TangentMatrix& mass) {
  const Vector resting = make_vector();
  evaluated_ = {};
  Access access(*this, x, v, resting, nullptr);
  access.begin_exchange();
  start_prescribed(t);
  set_prescribed({t, 0, 0});
  const TangentRequest request{mass, 0, 1, 0};
  run(NoLaw{}, {t, 0, 0}, access, &request);
  add_loads(t, access, &request);
}

void Assembler::force(double t, Vec x, Vec v, Vec force) {
  const Vector resting = make_vector();
  evaluated_ = {};
  Access access(*this, x, v, resting, force);
  access.begin_exchange();
  start_prescribed(t);
  set_prescribed({t, 0, 0});
  run(StageLaw<true>{rule_.tangent}, {t, 0, 0}, access, nullptr);
  add_loads(t, access, nullptr);
  access.close();
  check(VecScale(force, -1));
}

}   // namespace cablenet::system

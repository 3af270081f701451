#include "pretension.hpp"

#include <algorithm>
#include <cmath>

namespace cablenet::network {
namespace {

/// The most that sag makes a cable longer at first.  A search from a length that is too short comes down to the
/// tension; from one that is much too long, where the cable only lies, no slope shows the way.
constexpr double most_sag = 0.02;

double strain_at(const scene::Scene& scene, int type, double tension) {
  return tension / scene.cable_types[at(type)].axial_stiffness;
}

}   // namespace

std::vector<Pretension> pretensions_of(const scene::Scene& scene) {
  std::vector<Pretension> all;
  int span = 0;
  for (const scene::Cable& cable : scene.cables) {
    if (cable.tension) all.push_back({span, false, *cable.tension});
    ++span;
  }
  for (const scene::Net& net : scene.nets) {
    if (net.prestress) all.push_back({span, true, *net.prestress});
    ++span;
  }
  return all;
}

double first_length(const scene::Scene& scene, const scene::Cable& cable, const Vector3& a, const Vector3& b) {
  const scene::CableType& type = scene.cable_types[at(cable.type)];
  const double displaced = scene.fluid ? scene.fluid->density * type.area : 0;
  const double weight = scene.gravity * std::abs(type.mass_per_length - displaced);
  const double pull = weight * std::hypot(b.x() - a.x(), b.y() - a.y()) / *cable.tension;
  return (b - a).norm() * (1 + std::min(pull * pull / 24, most_sag)) /
         (1 + strain_at(scene, cable.type, *cable.tension));
}

double first_slack(const scene::Scene& scene, const scene::Net& net) {
  return 1 / (1 + strain_at(scene, net.type, *net.prestress));
}

}   // namespace cablenet::network

#pragma once
#include <type_traits>

#include "bed_grips.hpp"
#include "cablenet/environment/bed_contact.hpp"
#include "evaluation.hpp"
#include "scatter.hpp"

/// Contact with the bed for terms.  A term says what its contacts are: how many, and for each its node, how far it
/// reaches below its node [m], its area [m^2], its smoothing [m] and the stiffness of its spring of friction [Pa/m].
namespace cablenet::system {

/// The bed's force on a node.
/// @tparam Contacts  the term's   @tparam Laws  of friction: one of bed_grips.hpp
template <class Contacts, class Laws>
struct BedKernel {
  static constexpr bool owns_slots = false;

  Contacts contacts;
  environment::Bed bed;
  double softness;
  double dt;
  Laws laws;

  BedKernel(const Contacts& its, const environment::Bed& on, double by, double step, const Laws& friction)
      : contacts(its), bed(on), softness(by), dt(step), laws(friction) {
    bed.stiffness /= by;
    bed.damping /= by;
  }

  auto law(std::size_t i) const {
    return laws(i, contacts.friction_stiffness(i) * contacts.area(i), contacts.friction_delay(i));
  }
  double height(std::size_t i, const Vector3& x) const { return x.z() - contacts.reach(i); }

  template <bool with_tangent>
  environment::BedForce force(std::size_t i, const Vector3& x, const Vector3& v) const {
    const Vector3 lowest(x.x(), x.y(), height(i, x));
    return environment::bed_force<with_tangent>(bed, contacts.area(i), softness * contacts.smoothing(i), dt, lowest, v,
                                                law(i));
  }

  template <bool with_tangent, class Nodes, class Key>
  bool evaluate(std::size_t i, Key node, const Nodes& nodes, NodeResponse& out) const {
    const ConstVector x = nodes.x(node), v = nodes.v(node);
    // What statics holds rubs wherever it is.
    if constexpr (!std::is_same_v<Laws, SticksAsHeld>)
      if (height(i, x) - 0.5 * dt * std::abs(v.z()) > bed.level + softness * contacts.smoothing(i)) return false;
    const environment::BedForce push = force<with_tangent>(i, x, v);
    out.on = -push.force;
    if constexpr (with_tangent) {
      out.x = -push.by_x;
      out.v = -push.by_v;
      out.a.setZero();
    }
    return true;
  }
};

/// Calls visit(kernel) as a situation asks.
template <class Contacts, class Visit>
void visit_bed(const Contacts& contacts, const environment::Bed& bed, const Situation& situation, bool is_cautious,
               const BedGrips& grips, Visit&& visit) {
  visit_friction(bed, situation, is_cautious, grips, [&](const auto& laws) {
    BedKernel kernel(contacts, bed, contacts.softness(situation), situation.stage.dt, laws);
    if (situation.internal == InternalForce::of_statics) kernel.bed.damping = 0;
    visit(kernel);
  });
}

}   // namespace cablenet::system

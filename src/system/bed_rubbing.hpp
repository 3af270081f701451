#pragma once
#include "bed_kernel.hpp"

/// Moves the grips of a term's contacts from step to step, and gives statics the bed's potential.
namespace cablenet::system {

/// In statics friction is to hold before anything has travelled, as in the closed forms of moorings.  So its springs
/// are much stiffer there, unless the scene says how stiff they are.
constexpr double static_stiffening = 300;

/// @param places  per node; what has none rubs nowhere until the first step
template <class Contacts>
void put_grips(const Contacts& contacts, const environment::Bed& bed, const GripPlaces& places, BedGrips& grips) {
  grips.resize(contacts.size());
  grips.stiffen(bed.friction_stiffness > 0 ? 1 : static_stiffening);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const std::optional<Vector3>& place = places[contacts.node(i)];
    place ? grips.put(i, *place) : grips.release(i);
  }
}

/// Where the grip of a contact is at the start of a step.  It follows what slipped in the last step.  A step that is
/// tried again leaves it where it is.  The first step after statics has softer springs.  There the grip moves so that
/// the soft spring pulls as the stiff one did.
template <class Kernel>
Vector3 next_grip(const Kernel& kernel, const BedGrips& grips, std::size_t i, double N, const Vector3& x) {
  if (grips.is_free(i)) return x;
  if (grips.stiffening() == 1) return kernel.law(i).regripped(N, x);
  const environment::StickFriction stiff = kernel.law(i);
  return x + grips.stiffening() / stiff.stiffness * stiff.at<false>(N, x, Vector3::Zero()).force;
}

/// In time, moves the grips at the start of a step.  In statics, notes the pressures if the situation asks for it.
template <class Contacts>
void begin_rubbing(const Contacts& contacts, const environment::Bed& bed, Evaluation& evaluation, BedGrips& grips) {
  const Situation& situation = evaluation.situation;
  const bool is_static = situation.internal == InternalForce::of_statics;
  if (is_static && situation.sticking != Sticking::measured) return;
  evaluation.complete();
  const AnyNodes nodes{evaluation.data};
  BedKernel kernel(contacts, bed, 1, 0, Sticks{bed.friction, false, grips});
  if (is_static) kernel.bed.damping = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Vector3 x = nodes.x(contacts.node(i)), v = nodes.v(contacts.node(i));
    const double N = kernel.template force<false>(i, x, v).force.z();
    if (is_static)
      grips.hold(i, N, situation.measured_share);
    else
      grips.put(i, next_grip(kernel, grips, i, N, x));
  }
  if (is_static) return;
  grips.stiffen(1);
  grips.forget_last();
}

/// Of the bed's pressure, and of friction where it is held.  [J]
template <class Contacts>
double bed_potential(const Contacts& contacts, std::size_t count, const environment::Bed& bed,
                     const Situation& situation, const BedGrips& grips, const LocalState& state) {
  const double softness = contacts.softness(situation);
  const BedKernel kernel(contacts, bed, softness, 0, SticksAsHeld{{bed.friction, false, grips}});
  const bool rubs = bed.sticks() && situation.sticking == Sticking::held;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3 x = state.position(contacts.node(i));
    sum += kernel.bed.stiffness * contacts.area(i) *
           environment::indentation_integral(bed.level - kernel.height(i, x), softness * contacts.smoothing(i));
    if (rubs && !grips.is_free(i)) sum += kernel.law(i).law.potential(grips.held(i), x);
  }
  return sum;
}

}   // namespace cablenet::system

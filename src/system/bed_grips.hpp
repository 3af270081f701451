#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "cablenet/base/archive.hpp"
#include "cablenet/environment/bed.hpp"
#include "cablenet/environment/held_friction.hpp"
#include "cablenet/partition/local_network.hpp"
#include "cablenet/system/situation.hpp"

/// What friction by springs keeps of the contacts of a term, and which law of friction an evaluation takes.
namespace cablenet::system {

/// Per contact the grip of its spring, if it has one, and the force N that statics holds.
class BedGrips {
public:
  bool is_free(std::size_t contact) const { return std::isnan(grip_[2 * contact]); }
  /// Where the contact holds the bed.  [m]
  Vector3 at(std::size_t contact) const { return Vector3(grip_[2 * contact], grip_[2 * contact + 1], 0); }
  double held(std::size_t contact) const { return held_[contact]; }   ///< [N]

  /// How many times stiffer than they are in time the springs are.
  double stiffening() const { return stiffening_; }
  void stiffen(double times) { stiffening_ = times; }
  /// For StickFriction::last.
  double* last(std::size_t contact) const { return &last_[2 * contact]; }
  void forget_last() { std::fill(last_.begin(), last_.end(), 0.0); }
  void resize(std::size_t contacts) {
    last_.assign(2 * contacts, 0);
    grip_.resize(2 * contacts);
    held_.resize(contacts);
  }
  void release(std::size_t contact) { grip_[2 * contact] = std::numeric_limits<double>::quiet_NaN(); }
  void put(std::size_t contact, const Vector3& grip) {
    grip_[2 * contact] = grip.x();
    grip_[2 * contact + 1] = grip.y();
  }
  void hold(std::size_t contact, double N, double share) { held_[contact] += share * (N - held_[contact]); }
  /// What is held belongs to one search for an equilibrium.
  void archive(Archive& archive, const char* name) {
    archive.item(name, std::span(grip_));
    archive.item(name, stiffening_);
  }

private:
  std::vector<double> grip_, held_;
  mutable std::vector<double> last_;   ///< tangents write it, results do not depend on it
  double stiffening_ = 1;
};

/// Each makes the law of a contact whose spring has the stiffness k [N/m], and the damping k delay [N s/m].
struct NeverRubs {
  environment::NoFriction operator()(std::size_t, double, double) const { return {}; }
};
struct RubsByVelocity {
  environment::ViscousFriction law;
  environment::ViscousFriction operator()(std::size_t, double, double) const { return law; }
};
struct Sticks {
  double mu;
  bool is_damped;
  const BedGrips& grips;
  bool is_cautious = false;
  environment::StickFriction operator()(std::size_t contact, double k, double delay) const {
    return {grips.is_free(contact) ? 0 : mu,
            grips.stiffening() * k,
            is_damped ? delay * k : 0,
            grips.at(contact),
            is_cautious,
            grips.last(contact)};
  }
};
struct SticksAsHeld {
  Sticks springs;
  environment::HeldFriction<environment::StickFriction> operator()(std::size_t contact, double k, double delay) const {
    return {springs(contact, k, delay), springs.grips.held(contact)};
  }
};

/// Calls visit(laws) with that which the bed and the situation ask for, so that loops have no branch for it.
template <class Visit>
void visit_friction(const environment::Bed& bed, const Situation& situation, bool is_cautious, const BedGrips& grips,
                    Visit&& visit) {
  if (bed.friction == 0) return visit(NeverRubs{});
  if (!bed.sticks()) return visit(RubsByVelocity{{bed.friction, bed.friction_velocity}});
  if (situation.sticking == Sticking::absent) return visit(NeverRubs{});
  const bool is_static = situation.internal == InternalForce::of_statics;
  const Sticks springs{bed.friction, !is_static, grips, is_cautious};
  if (situation.sticking == Sticking::held) return visit(SticksAsHeld{springs});
  visit(springs);
}

}   // namespace cablenet::system

#pragma once
#include <cmath>

#include "cablenet/elements/cable_data.hpp"

/// Morison's drag per unstretched length of a fully wet cable, and what is across a cable; cable_in_water_loads.hpp
/// inlines it.  Source and tests: see cable_in_water.hpp.
namespace cablenet::elements {

/// The part of a vector across the unit vector e.
inline Vector3 across(const Vector3& e, const Vector3& w) { return w - e.dot(w) * e; }
inline Matrix3 across(const Vector3& e) { return Matrix3::Identity() - e.lazyProduct(e.transpose()); }

/// The share that an element has of the couple by which drag slows a straight rod that turns in a flow across it.  A
/// chord that turns because the cable moves along a curve has none of it, and one that vibrates has all.
constexpr double turning_share = 0.5;

/// The drag of a flow u relative to a cable along e: ut along the cable and un across it.
/// The derivatives are by u, and by e where e changes direction but not length.
class CrossFlow {
public:
  CrossFlow(const CableInWater& c, const Vector3& e, const Vector3& u)
      : e_(e),
        ut_(e.dot(u)),
        un_(u - ut_ * e),
        normal_(c.normal_drag),
        speed_(un_.norm()),
        across_(normal_ * speed_),
        along_(c.tangential_drag * std::abs(ut_)) {}

  Vector3 drag() const { return across_ * un_ + along_ * ut_ * e_; }

  /// turning_share normal_drag |un|, by which drag slows what turns the chord, and its derivatives by u and by e.
  double slowing() const { return turning_share * across_; }
  Vector3 slowing_by_flow() const { return (speed_ > 0 ? turning_share * normal_ / speed_ : 0) * un_; }
  Vector3 slowing_by_axis() const { return -ut_ * slowing_by_flow(); }

  Matrix3 by_flow() const {
    Matrix3 by = normal_part(1) + e_.lazyProduct(((2 * along_ - across_) * e_).transpose());
    by.diagonal().array() += across_;
    return by;
  }
  Matrix3 by_axis() const {
    const double turning = (along_ - across_) * ut_;
    Matrix3 by = normal_part(-ut_) + e_.lazyProduct(((2 * along_ - across_) * un_ - turning * e_).transpose());
    by.diagonal().array() += turning;
    return by;
  }

private:
  /// scale times normal_drag un un^T/|un|
  Matrix3 normal_part(double scale) const {
    const double factor = speed_ > 0 ? scale * normal_ / speed_ : 0;
    return (factor * un_).lazyProduct(un_.transpose());
  }

  Vector3 e_;
  double ut_;
  Vector3 un_;
  double normal_, speed_, across_, along_;   ///< across_ = normal_drag |un|, along_ = tangential_drag |ut|
};

}   // namespace cablenet::elements

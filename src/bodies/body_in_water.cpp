#include "cablenet/bodies/body_in_water.hpp"

#include <cmath>

#include "cablenet/environment/water.hpp"

namespace cablenet::bodies {
namespace {

/// The wetted fraction of a sphere, and the fraction's derivative by the place of the sphere's middle.
struct Immersion {
  double fraction = 1;
  Vector3 by_x = Vector3::Zero();   ///< [1/m]
};

Immersion immersion(const environment::Fluid& fluid, double t, double radius, const Vector3& x) {
  if (!fluid.surface) return {};
  const double still = *fluid.surface - x.z();
  if (std::abs(still) >= fluid.reach() + radius) return {still > 0 ? 1.0 : 0.0};
  const environment::SurfaceHeight surface = environment::surface_height(fluid, x, t);
  const environment::Wetness wet = environment::sphere_wetness(surface.z - x.z(), radius);
  return {wet.fraction, wet.by_depth * (surface.slope - Vector3::UnitZ())};
}

/// Sets the derivatives of the load wet.fraction * under_water.
/// @param under_water  the load of a fully wet object; it depends on x through u and w alone
/// @param by_u, by_w   the derivatives of under_water
void set_slopes(const Immersion& wet, const Matrix3& by_u, const Matrix3& by_w, const environment::WaterMotion& water,
                const Vector3& under_water, PointLoad& load) {
  load.by_v = -wet.fraction * by_u;
  load.by_a = -wet.fraction * by_w;
  load.by_x = under_water * wet.by_x.transpose();
  load.by_x += wet.fraction * (by_u * water.velocity_slope + by_w * water.acceleration_slope);
}

}   // namespace

PointLoad point_load(const PointInWater& point, const environment::Fluid& fluid, double t, double gravity,
                     const PointMotion& motion) {
  PointLoad load{Vector3::Zero()};
  const Immersion wet = immersion(fluid, t, point.radius, motion.x);
  if (wet.fraction == 0) return load;
  const environment::WaterMotion water = environment::water_motion(fluid, motion.x, t);
  const Vector3 u = water.velocity - motion.v, w = water.acceleration - motion.a;
  const double speed = u.norm();
  Vector3 full = point.drag * speed * u + point.added * w + point.displaced * water.acceleration;
  full.z() += point.displaced * gravity;
  Matrix3 by_u = point.drag * speed * Matrix3::Identity();
  if (speed > 0) by_u += point.drag / speed * u * u.transpose();
  set_slopes(wet, by_u, point.added * Matrix3::Identity(), water, full, load);
  load.by_x += wet.fraction * point.displaced * water.acceleration_slope;
  load.force = wet.fraction * full;
  return load;
}

BodyLoad body_load(const BodyInWater& body, const environment::Fluid& fluid, double t, const Matrix3& R,
                   const PointMotion& motion) {
  BodyLoad load{{Vector3::Zero()}};
  const Immersion wet = immersion(fluid, t, body.radius, motion.x);
  if (wet.fraction == 0) return load;
  const environment::WaterMotion water = environment::water_motion(fluid, motion.x, t);
  load.u = water.velocity - motion.v;
  load.w = water.acceleration - motion.a;
  const Vector3 u = R.transpose() * load.u, w = R.transpose() * load.w, speed = u.cwiseAbs();
  const Vector3 full = (body.linear + body.quadratic.cwiseProduct(speed)).cwiseProduct(u) + body.added.cwiseProduct(w);
  const Matrix3 by_u = (body.linear + 2 * body.quadratic.cwiseProduct(speed)).asDiagonal();
  const Matrix3 by_w = body.added.asDiagonal();
  set_slopes(wet, R * by_u * R.transpose(), R * by_w * R.transpose(), water, R * full, load);
  load.inner = wet.fraction * full;
  load.by_u = wet.fraction * by_u;
  load.by_w = wet.fraction * by_w;
  load.force = R * load.inner;
  return load;
}

double turning_drag_power(const Properties& body, const Vector3& w) {
  return (body.linear_drag + body.quadratic_drag.cwiseProduct(w.cwiseAbs())).dot(w.cwiseAbs2());
}

}   // namespace cablenet::bodies

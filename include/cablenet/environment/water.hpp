#pragma once
#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/environment/fluid.hpp"

/// The water: current, free surface, linear (Airy) waves.  z is up; the still surface is at Fluid::surface, the waves'
/// own height z' = z - surface <= 0 below it, the bed of their theory at z' = -depth.
/// With theta = k s - omega t + phase, s along the direction, a = height/2, omega^2 = g k tanh(k depth):
///   elevation   a cos(theta)
///   horizontal  a omega cosh(k (z' + depth))/sinh(k depth) cos(theta),  vertical the same with sinh and sin
/// (deep water: e^(k z')), accelerations their time derivatives; the dynamic pressure's gradient is -rho times the
/// acceleration.  Above the still surface the kinematics are those at it (vertical stretching), below the bed those at
/// the bed.  Components and current add up, without Doppler shift.
/// Source: Dean & Dalrymple, Water Wave Mechanics for Engineers and Scientists (1991), ch. 3, 4.
/// Tests: tests/unit/water_test.cpp
namespace cablenet::environment {

/// k > 0 of omega^2 = g k tanh(k depth).  [1/m]
/// @param frequency [rad/s], > 0   @param depth [m], > 0   @param gravity [m/s^2], > 0
double wave_number(double frequency, double depth, double gravity);

/// Velocity and acceleration of the water at a place, and their derivatives by it.
struct WaterMotion {
  Vector3 velocity = Vector3::Zero();             ///< [m/s]
  Vector3 acceleration = Vector3::Zero();         ///< [m/s^2]
  Matrix3 velocity_slope = Matrix3::Zero();       ///< [1/s]
  Matrix3 acceleration_slope = Matrix3::Zero();   ///< [1/s^2]
};
WaterMotion water_motion(const Fluid&, const Vector3& x, double t);

/// z of the free surface above or below x, and its derivative by x.  @pre there is a surface
struct SurfaceHeight {
  double z;        ///< [m]
  Vector3 slope;   ///< z component 0
};
SurfaceHeight surface_height(const Fluid&, const Vector3& x, double t);

/// How much of a thing is under water, 0..1, and the derivatives.
struct Wetness {
  double fraction;
  double by_depth;    ///< by the depth of its middle below the surface [1/m]
  double by_extent;   ///< by its vertical extent [1/m]
};
/// Of a straight piece of a cable, of vertical extent h >= 0 and diameter d, whose middle is q below the surface: the
/// mean over the piece of the smooth step s^2 (3 - 2 s), s = depth/d + 1/2 between 0 and 1.  For h >> d the exact
/// wetted length, differentiable everywhere.
Wetness piece_wetness(double q, double h, double d);
/// Of a sphere of radius r: the spherical cap's volume, s^2 (3 - 2 s) with s = q/(2 r) + 1/2.  A point, r = 0, is wet
/// or dry.
Wetness sphere_wetness(double q, double r);

}   // namespace cablenet::environment

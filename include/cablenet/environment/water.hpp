#pragma once
#include <vector>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/environment/fluid.hpp"

/// The motion of the water: current, free surface, linear (Airy) waves.  z points up.  Wave theory has a height of its
/// own, z' = z - Fluid::surface: z' = 0 is the still surface, and z' = -depth is the bed.
/// With theta = k s - omega t + phase, s the distance along the wave's direction, a = height/2 and
/// omega^2 = g k tanh(k depth), a wave has
///   elevation            a cos(theta)
///   horizontal velocity  a omega cosh(k (z' + depth))/sinh(k depth) cos(theta)
///   vertical velocity    a omega sinh(k (z' + depth))/sinh(k depth) sin(theta)
/// In deep water both quotients become e^(k z').  The accelerations are the time derivatives of the velocities, and the
/// gradient of the dynamic pressure is -rho times the acceleration.  Above the still surface the water moves as at the
/// still surface (vertical stretching).  Below the bed it moves as at the bed.  Waves and current add up, without
/// Doppler shift.
/// Source: Dean & Dalrymple, Water Wave Mechanics for Engineers and Scientists (1991), ch. 3, 4.
/// Tests: tests/unit/water_test.cpp
namespace cablenet::environment {

/// The solution k > 0 of omega^2 = g k tanh(k depth).  [1/m]
/// @param frequency  omega [rad/s], > 0   @param depth [m], > 0   @param gravity [m/s^2], > 0
double wave_number(double frequency, double depth, double gravity);

/// Velocity and acceleration of the water at a place, and their derivatives by the place.
struct WaterMotion {
  Vector3 velocity = Vector3::Zero();             ///< [m/s]
  Vector3 acceleration = Vector3::Zero();         ///< [m/s^2]
  Matrix3 velocity_slope = Matrix3::Zero();       ///< [1/s]
  Matrix3 acceleration_slope = Matrix3::Zero();   ///< [1/s^2]
};
WaterMotion water_motion(const Fluid&, const Vector3& x, double t);

/// The faintest waves that add at most `share` of all waves' velocity and of their acceleration, and where the surface
/// may come to z of its elevation, each taken at its largest and at the height z.  Indices into Fluid::waves,
/// ascending.
std::vector<std::size_t> faint_waves(const Fluid&, double z, double share);

/// The height of the free surface on the vertical through x, and its derivative by x.  @pre the fluid has a surface
struct SurfaceHeight {
  double z;        ///< [m]
  Vector3 slope;   ///< z component 0
};
SurfaceHeight surface_height(const Fluid&, const Vector3& x, double t);

/// The fraction of an object that is under water, 0 .. 1, and its derivatives.
struct Wetness {
  double fraction;
  double by_depth;    ///< by the depth of the object's middle below the surface [1/m]
  double by_extent;   ///< by the object's vertical extent [1/m]
};
/// Wetness of a straight piece of cable with vertical extent h >= 0 and diameter d, whose middle is q below the surface
/// [m].  The fraction is the mean over the piece of the smooth step s^2 (3 - 2 s), where s is depth/d + 1/2, but at
/// least 0 and at most 1.  It is differentiable everywhere, and for h >> d it is the exact wetted part of the length.
Wetness piece_wetness(double q, double h, double d);
/// Wetness of a sphere of radius r whose middle is q below the surface [m].  The fraction is the volume of the
/// spherical cap over that of the sphere: s^2 (3 - 2 s) with s = q/(2 r) + 1/2.  A point (r = 0) is either wet or dry.
Wetness sphere_wetness(double q, double r);

}   // namespace cablenet::environment

#pragma once
#include <optional>
#include <vector>

#include "cablenet/base/linear_algebra.hpp"

namespace cablenet::scene {
struct Scene;
struct CableType;
}   // namespace cablenet::scene

/// `shape: catenary`: where a cable without stretch hangs between its ends.  A cable that floats hangs upwards.  What
/// is too long for hanging freely comes to lie on the bed, or afloat on the surface.
/// Source of the part that lies: Jonkman, NREL/EL-500-41958 (2007), ch. 2.7, for cables without stretch.
/// Tests: tests/parallel/hanging_test.cpp
namespace cablenet::network {

/// What pulls at a cable, and what it comes to lie on.
struct Hanging {
  bool floats = false;            ///< It is pulled upwards.
  std::optional<double> rest{};   ///< height of what it comes to lie on [m]
  /// The pull per length before `rest` over the one that brings back what is beyond.  0: none can be beyond.
  double beyond = 0;
};

/// Of a cable between two ends as drawn.  Currents and waves are left out.
Hanging hanging_of(const scene::Scene& scene, const scene::CableType& type, const Vector3& a, const Vector3& b);

/// Points at the arc lengths `arcs` of the inextensible cable of length L between a and b.
///   - Where L <= |b - a| it is straight.
///   - Where it hangs freely it is the catenary, or a hairpin between ends that lie nearly above one another.
///   - Where it touches `rest` two legs come down to it flat, as arcs of catenaries of one horizontal pull.  What is
///     between them lies straight.  Where so much lies that nothing pulls, the legs are upright and the rest of the
///     cable lies in an arc of a circle.
std::vector<Vector3> catenary_shape(const Vector3& a, const Vector3& b, const std::vector<double>& arcs,
                                    const Hanging& hanging = {});

}   // namespace cablenet::network

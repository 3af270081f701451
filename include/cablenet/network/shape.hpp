#pragma once
#include <vector>

#include "cablenet/base/linear_algebra.hpp"

/// Where a cable's nodes lie at the start.  Tests: tests/parallel/shape_test.cpp
namespace cablenet::network {

/// Unstretched arc lengths of `elements` + 1 nodes on a cable of length L: nodes at 0, L and every tap, the elements
/// shared out between taps in proportion to length (at least one each), even between them.
/// @param taps [m] in [0, L], any order
/// @throws InputError if there are more stretches between taps than elements.
std::vector<double> node_arcs(double L, int elements, std::vector<double> taps);

/// Index of the node at arc length `at`.  @pre node_arcs was told of it.
int node_at(const std::vector<double>& arcs, double at);

/// Points on the straight line a-b at the fractions arcs/L.
std::vector<Vector3> straight_shape(const Vector3& a, const Vector3& b, const std::vector<double>& arcs);

/// Points on the inextensible catenary of length L hung between a and b, at the arc lengths; the straight line where
/// L <= |b - a|.
std::vector<Vector3> catenary_shape(const Vector3& a, const Vector3& b, const std::vector<double>& arcs);

/// Points on a polyline at the fractions arcs/L of its drawn length; its own points where it has one per node.
std::vector<Vector3> polyline_shape(const std::vector<Vector3>& polyline, const std::vector<double>& arcs);

}   // namespace cablenet::network

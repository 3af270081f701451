#pragma once
#include <vector>

#include "cablenet/base/linear_algebra.hpp"

/// These functions place a cable's nodes at the start.  Tests: tests/parallel/shape_test.cpp
namespace cablenet::network {

/// The unstretched arc lengths of the `elements` + 1 nodes of a cable of length L.  [m]
/// There are nodes at 0, at L and at every tap, which divide the cable into stretches.  A stretch gets elements in
/// proportion to its length, but at least one, and its elements are equally long.
/// @param taps  arc lengths [m] in [0, L], in any order
/// @throws InputError if there are more stretches than elements
std::vector<double> node_arcs(double L, int elements, std::vector<double> taps);

/// The index of the node at arc length `at`.  @pre `at` is 0, L or a tap that node_arcs was given
int node_at(const std::vector<double>& arcs, double at);

/// Points on the straight line a-b at the fractions arcs/L.
std::vector<Vector3> straight_shape(const Vector3& a, const Vector3& b, const std::vector<double>& arcs);

/// Points on a polyline at the fractions arcs/L of its drawn length.  If the polyline has one point per node, these are
/// the points.
std::vector<Vector3> polyline_shape(const std::vector<Vector3>& polyline, const std::vector<double>& arcs);

}   // namespace cablenet::network

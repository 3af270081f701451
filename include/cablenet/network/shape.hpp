#pragma once
#include <vector>

#include "cablenet/base/linear_algebra.hpp"

/// These functions place a cable's nodes at the start.  Tests: tests/parallel/shape_test.cpp
namespace cablenet::network {

/// The unstretched arc lengths of the `elements` + 1 nodes of a cable of length L.  [m]
/// There are nodes at 0, at L and at every tap, which divide the cable into stretches.  A stretch gets elements in
/// proportion to its length, but at least one, and its elements are equally long.
/// With a density a stretch gets elements in proportion to the density's integral, and each of its elements has the
/// same part of that.
/// @param taps  arc lengths [m] in [0, L], in any order
/// @param density  of elements, relative, > 0, in equal parts of the cable; empty: everywhere alike
/// @throws InputError if there are more stretches than elements
std::vector<double> node_arcs(double L, int elements, std::vector<double> taps,
                              const std::vector<double>& density = {});

/// The index of the node at arc length `at`.  @pre `at` is 0, L or a tap that node_arcs was given
int node_at(const std::vector<double>& arcs, double at);

/// What rows that lie evenly say at a fraction from 0 to 1 between the first and the last one.
Vector3 row_at(const std::vector<Vector3>& rows, double fraction);

/// Points on the straight line a-b at the fractions arcs/L.
std::vector<Vector3> straight_shape(const Vector3& a, const Vector3& b, const std::vector<double>& arcs);

/// Points on a polyline at the fractions arcs/L of its drawn length.  If the polyline has one point per node, these are
/// the points.
std::vector<Vector3> polyline_shape(const std::vector<Vector3>& polyline, const std::vector<double>& arcs);

/// Likewise, for a mesh that the polyline was not drawn for.  If its legs are about equally long, it has one point per
/// node of another mesh, and its legs are equally long without stretch.  The points lie about on a cubic spline.  A
/// chord is as long as the part of the polyline that it spans, so that the cable has the stretch that was drawn.
std::vector<Vector3> remeshed_shape(const std::vector<Vector3>& polyline, const std::vector<double>& arcs);

}   // namespace cablenet::network

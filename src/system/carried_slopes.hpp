#pragma once
#include "carried_nodes.hpp"
#include "scatter.hpp"

/// Slopes of kernels of two nodes as carried nodes need them: by a node's position [N/m], velocity [N s/m] and
/// acceleration [kg] apart.
namespace cablenet::system {

/// A slope that is zero whatever the state.
struct NoSlope {};

/// A slope by the centre of gravity of the body that carries a node.  Attitudes do not move it.
struct CentralSlope {
  Matrix3 x;
};

inline void add_scaled(Matrix3& sum, double s, const Matrix3& K) { sum += s * K; }
inline void add_scaled(Matrix3& sum, double s, double m) { sum.diagonal().array() += s * m; }
inline void add_scaled(Matrix3&, double, NoSlope) {}
inline void add_scaled(Matrix3& sum, double s, const CentralSlope& K) { sum += s * K.x; }

/// K T row by row, which is several times faster than Eigen's product of such shapes.
inline void add_product(bodies::RowMajor<3, 4>& sum, const Matrix3& K, const bodies::RowMajor<3, 4>& T) {
  for (int i = 0; i < 3; ++i) sum.row(i) += K(i, 0) * T.row(0) + K(i, 1) * T.row(1) + K(i, 2) * T.row(2);
}
inline void add_product(bodies::RowMajor<3, 4>& sum, double m, const bodies::RowMajor<3, 4>& T) { sum += m * T; }
inline void add_product(bodies::RowMajor<3, 4>&, NoSlope, const bodies::RowMajor<3, 4>&) {}
inline void add_product(bodies::RowMajor<3, 4>&, const CentralSlope&, const bodies::RowMajor<3, 4>&) {}

/// The slopes of a kernel of two nodes, whatever its structure: three calls with one shift each.
struct PairApart {
  PairResponse by_x, by_v, by_a;

  template <class Kernel, class Item>
  bool fill(const Kernel& kernel, std::size_t i, const Item& item, const AnyNodes& nodes) {
    return kernel.template evaluate<true, true>(i, item, nodes, Shift{1, 0, 0}, by_x) &&
           kernel.template evaluate<false, true>(i, item, nodes, Shift{0, 1, 0}, by_v) &&
           kernel.template evaluate<false, true>(i, item, nodes, Shift{0, 0, 1}, by_a);
  }
  const Vector3& on(std::size_t i) const { return by_x.on[i]; }
  const Matrix3& x(std::size_t i, std::size_t j) const { return by_x.by[i][j]; }
  const Matrix3& v(std::size_t i, std::size_t j) const { return by_v.by[i][j]; }
  const Matrix3& a(std::size_t i, std::size_t j) const { return by_a.by[i][j]; }
};

}   // namespace cablenet::system

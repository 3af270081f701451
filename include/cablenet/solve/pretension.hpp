#pragma once
#include <Eigen/Core>

#include "cablenet/network/network.hpp"
#include "cablenet/solve/static_newton.hpp"

/// The unstretched lengths with which cables and nets have the tensions that they are asked to have in the equilibrium
/// (network::Pretension).  The unknowns are q, the logarithms of the factors on their lengths.  Newton's method on
/// T(q) = T* takes each T at an equilibrium, found from the one before, and the slopes
///   dT/dq = dT/dq|x + dT/dx dx/dq,  with  tangent dx/dq = -dr/dq,
/// by differences along lengths and along (dx/dq, q).  Where tensions do not depend on lengths apart, as along a line
/// of several cables, the smallest change of lengths is taken.  A change is shortened until the tensions come nearer.
/// A cable that sags is pulled less as it becomes shorter, down to a least tension, and then more and more.  Where it
/// has too little tension and would have more by its weight, it is made shorter until it is past that.
/// Tests: tests/parallel/pretension_test.cpp, tests/verification/pretension.py
namespace cablenet::solve {

/// All member functions are collective.
class PretensionSearch {
public:
  /// Reads the options database (-ksp_*, -pc_*, -cable_statics_*).
  /// @param assembler  whose start is what is drawn
  /// @param velocity   of the frame in which nothing moves [m/s]
  PretensionSearch(system::Assembler& assembler, const network::Network& network, double t, const Vector3& velocity);

  /// The assembler then starts from the equilibrium with these lengths, or from the best that there was.
  /// @returns whether they were found
  bool solve();
  /// Per pretension: the length found over the network's.
  const std::vector<double>& factors() const { return factors_; }
  /// Per pretension, with the lengths found.  [N]
  const Eigen::VectorXd& tensions() const { return tensions_; }
  /// Index of the pretension whose tension is farthest off.
  std::size_t worst() const;
  const std::string& failure() const { return failure_; }
  /// One tension was asked for, and no length gives it: the search ended where the tension is at its least.
  bool is_least() const { return is_least_; }
  /// Otherwise there was none even with the network's lengths.
  bool has_equilibrium() const { return has_equilibrium_; }
  /// Of all equilibria on the way.
  int iterations() const { return iterations_; }

private:
  bool find_equilibrium(Eigen::VectorXd& tensions);
  Eigen::VectorXd measure(Vec x);
  double mean_of_net(const network::Span& span, const std::vector<double>& tensions) const;
  void lengthen(std::size_t index, double factor);
  bool find_slopes(Eigen::MatrixXd& slopes);
  bool factor_tangent(Vec x);
  bool take(const Eigen::VectorXd& change, bool whatever = false);
  Eigen::VectorXd misses(const Eigen::VectorXd& tensions) const;

  system::Assembler& assembler_;
  const network::Network& network_;
  double t_;
  Vector3 velocity_;
  StaticForces forces_;
  std::vector<int> first_element_;   ///< per pretension of a cable: its first element's local index, if it is here
  std::vector<double> factors_;
  Eigen::VectorXd tensions_;
  int iterations_ = 0;
  bool has_equilibrium_ = false, is_least_ = false;
  std::string failure_;
  system::TangentMatrix tangent_;
  KrylovSolver ksp_;
  LinearSolver linear_;
  system::Vector x_, v_, resting_, moved_, r_, slope_;
};

}   // namespace cablenet::solve

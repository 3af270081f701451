#include "cablenet/solve/pretension.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "cablenet/solve/statics.hpp"

namespace cablenet::solve {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using petsc::check;

/// The difference of tensions over what is asked for at which the search ends, and the one that passes where rounding
/// of positions ends it before.
constexpr double wanted = 1e-10, enough = 1e-6;

constexpr int most_changes = 60, most_cuts = 12;

/// The largest change of the logarithm of a length at once, and the one with which a cable leaves the lengths with
/// which its weight pulls, at most so often.
constexpr double largest_change = 0.3, leaving = -0.2;
constexpr int most_leavings = 20;

/// The change of the logarithm of a length by which slopes are found.  Elements stretched by less would go slack by it.
constexpr double difference = 1e-8;

/// A tension is at its least where it changes by less than this part of what it is too large by, with the logarithm of
/// the length.
constexpr double flat = 0.1;

/// The slopes of tensions that depend on lengths alike are taken to be equal to within this.
constexpr double alike = 1e-6;

/// What is added to a singular tangent: masses as in a step of pseudo-time.  [1/s]
constexpr double pseudo_rates[] = {0, 1e-3, 1e-1};

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Where cables have too little tension, and more if they were longer, they are too long.
VectorXd shorter(const VectorXd& misses, const MatrixXd& slopes) {
  VectorXd change = VectorXd::Zero(misses.size());
  for (Eigen::Index i = 0; i < misses.size(); ++i)
    if (misses(i) < 0 && slopes(i, i) > alike) change(i) = leaving;
  return change;
}

}   // namespace

PretensionSearch::PretensionSearch(system::Assembler& assembler, const network::Network& network, double t,
                                   const Vector3& velocity)
    : assembler_(assembler),
      network_(network),
      t_(t),
      velocity_(velocity),
      forces_(assembler, t, velocity),
      factors_(network.pretensions.size(), 1),
      tensions_(VectorXd::Zero(static_cast<Eigen::Index>(network.pretensions.size()))),
      tangent_(assembler.make_tangent()) {
  for (auto* vector : {&x_, &v_, &resting_, &moved_, &r_, &slope_}) *vector = assembler.make_vector();
  const std::vector<int>& scene_element = assembler.network().scene_element;
  for (const network::Pretension& pretension : network.pretensions) {
    const auto own = scene_element.begin() + assembler.network().own_elements;
    const auto found = std::find(scene_element.begin(), own, network.spans[at(pretension.span)].first_element);
    first_element_.push_back(found == own ? -1 : static_cast<int>(found - scene_element.begin()));
  }
  check(KSPCreate(assembler.communicator(), ksp_.out()));
  linear_ = LinearSolver(ksp_, assembler.network(), tangent_.matrix());
}

VectorXd PretensionSearch::misses(const VectorXd& tensions) const {
  VectorXd misses = tensions;
  for (Eigen::Index i = 0; i < misses.size(); ++i)
    misses(i) = tensions(i) / network_.pretensions[static_cast<std::size_t>(i)].tension - 1;
  return misses;
}

std::size_t PretensionSearch::worst() const {
  Eigen::Index index = 0;
  misses(tensions_).cwiseAbs().maxCoeff(&index);
  return static_cast<std::size_t>(index);
}

void PretensionSearch::lengthen(std::size_t index, double factor) {
  const network::Span& span = network_.spans[at(network_.pretensions[index].span)];
  assembler_.lengthen(span.first_element, span.elements, factor);
}

double PretensionSearch::mean_of_net(const network::Span& span, const std::vector<double>& tensions) const {
  const partition::LocalNetwork& here = assembler_.network();
  double sums[2] = {0, 0};
  for (std::size_t i = 0; i < tensions.size(); ++i) {
    const int element = here.scene_element[i];
    if (element < span.first_element || element >= span.first_element + span.elements) continue;
    sums[0] += here.elements[i].length * tensions[i];
    sums[1] += here.elements[i].length;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, assembler_.communicator());
  return sums[0] / sums[1];
}

/// Of a cable it is what the history calls tension_from.
VectorXd PretensionSearch::measure(Vec x) {
  const int count = static_cast<int>(tensions_.size());
  const std::vector<double> tensions = forces_.element_tensions(x);
  VectorXd cables = VectorXd::Zero(count), nets = cables;
  assembler_.observe(t_, x, v_, resting_, true);
  for (int i = 0; i < count; ++i) {
    const int first = first_element_[at(i)];
    const network::Pretension& pretension = network_.pretensions[at(i)];
    if (pretension.is_net)
      nets(i) = mean_of_net(network_.spans[at(pretension.span)], tensions);
    else if (first >= 0)
      cables(i) = std::copysign(assembler_.end_force(first, 0).norm(), tensions[at(first)]);
  }
  MPI_Allreduce(MPI_IN_PLACE, cables.data(), count, MPI_DOUBLE, MPI_SUM, assembler_.communicator());
  return nets + cables;
}

/// From the assembler's start, which becomes the equilibrium where there is one.
bool PretensionSearch::find_equilibrium(VectorXd& tensions) {
  Statics statics(assembler_, t_, velocity_);
  const bool found = statics.solve();
  iterations_ += statics.iterations();
  if (!found) {
    failure_ = "there is no equilibrium with them: " + statics.failure();
    return false;
  }
  statics.make_start();
  assembler_.fill_initial(x_, v_);
  tensions = measure(x_);
  return true;
}

bool PretensionSearch::factor_tangent(Vec x) {
  for (const double rate : pseudo_rates) {
    forces_.keep(x);
    int is_solved = forces_.residual({system::StaticRule::Kind::exact}, x, r_, &tangent_, {rate, 0}) ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &is_solved, 1, MPI_INT, MPI_LAND, assembler_.communicator());
    check(KSPSolve(ksp_, r_, moved_));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    PetscReal size = 0;
    check(KSPGetConvergedReason(ksp_, &reason));
    check(VecNorm(moved_, NORM_2, &size));
    if (is_solved != 0 && reason >= 0 && std::isfinite(size)) return true;
    linear_.recover();
  }
  failure_ = "the equilibrium can move without any force";
  return false;
}

/// Column j: how the tensions, over what they shall be, follow the logarithm of length j.
bool PretensionSearch::find_slopes(MatrixXd& slopes) {
  if (!factor_tangent(x_)) return false;
  for (std::size_t j = 0; j < factors_.size(); ++j) {
    const auto residual_at = [&](double factor, Vec r) {
      lengthen(j, factor);
      forces_.residual({system::StaticRule::Kind::exact}, x_, r, nullptr, {});
      lengthen(j, 1 / factor);
    };
    residual_at(std::exp(difference), slope_);
    residual_at(std::exp(-difference), r_);
    check(VecAXPY(r_, -1, slope_));
    check(KSPSolve(ksp_, r_, slope_));   // dx/dq times twice the difference
    const auto tensions_at = [&](double share) {
      check(VecWAXPY(moved_, 0.5 * share, slope_, x_));
      lengthen(j, std::exp(share * difference));
      const VectorXd tensions = misses(measure(moved_));
      lengthen(j, std::exp(-share * difference));
      return tensions;
    };
    const VectorXd after = tensions_at(1), before = tensions_at(-1);
    slopes.col(static_cast<Eigen::Index>(j)) = (after - before) / (2 * difference);
  }
  return slopes.allFinite();
}

/// @param whatever  becomes of the tensions; otherwise the change is shortened until they come nearer
/// @returns whether it is taken
bool PretensionSearch::take(const VectorXd& change, bool whatever) {
  const double before = misses(tensions_).norm();
  double share = std::min(1.0, largest_change / change.cwiseAbs().maxCoeff());
  const system::Vector start = assembler_.make_vector();
  check(VecCopy(x_, start));
  for (int i = 0; i < most_cuts; ++i, share *= 0.5) {
    std::vector<double> factors = factors_;
    for (std::size_t j = 0; j < factors.size(); ++j) {
      factors[j] *= std::exp(share * change(static_cast<Eigen::Index>(j)));
      lengthen(j, factors[j] / factors_[j]);
    }
    VectorXd tensions = tensions_;
    if (find_equilibrium(tensions) && (whatever || misses(tensions).norm() < before)) {
      factors_ = factors;
      tensions_ = tensions;
      return true;
    }
    for (std::size_t j = 0; j < factors.size(); ++j) lengthen(j, factors_[j] / factors[j]);
    assembler_.start_from(t_, start, velocity_);
    check(VecCopy(start, x_));
  }
  return false;
}

bool PretensionSearch::solve() {
  has_equilibrium_ = find_equilibrium(tensions_);
  if (!has_equilibrium_) return false;
  const Eigen::Index count = tensions_.size();
  double miss = infinite;
  int leavings = 0;
  for (int i = 0; i < most_changes; ++i) {
    const VectorXd now = misses(tensions_);
    miss = now.cwiseAbs().maxCoeff();
    if (miss <= wanted) return true;
    MatrixXd slopes(count, count);
    if (!find_slopes(slopes)) break;
    const VectorXd leaves = shorter(now, slopes);
    if (!leaves.isZero(0) && leavings++ < most_leavings && take(leaves, true)) continue;
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> decomposition;
    decomposition.setThreshold(alike);
    const VectorXd change = decomposition.compute(slopes).solve(-now);
    if (change.allFinite() && !change.isZero(0) && take(change)) continue;
    failure_ = "no length brings it nearer";
    is_least_ = count == 1 && now(0) > 0 && std::abs(slopes(0, 0)) < flat * now(0);
    break;
  }
  return miss <= enough;
}

}   // namespace cablenet::solve

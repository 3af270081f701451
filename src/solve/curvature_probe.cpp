#include "cablenet/solve/curvature_probe.hpp"

#include <algorithm>
#include <cmath>

#include "cablenet/petsc/handle.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;

/// Where moving the guess does not help, it is tried again after twice as many solves in doubt, up to these.
constexpr int least_patience = 2, most_patience = 512;

/// Steps that differ by rounding have the same length.
constexpr double same_step = 1e-6;

}   // namespace

bool suits_probes(const system::Assembler& assembler) {
  int links = assembler.network().own_links;
  MPI_Allreduce(MPI_IN_PLACE, &links, 1, MPI_INT, MPI_SUM, assembler.communicator());
  return links == 0;
}

void CurvatureProbe::begin_solve(double dt, Vec x0, Vec guess) {
  is_probing_ = std::abs(dt - dt_) <= same_step * dt_;
  if (is_probing_) {
    check(VecAXPBYPCZ(guess, moved, -moved, 1, x0, guess_));
    forget();
  } else if (is_on_ && doubts_ >= patience_) {
    check(VecCopy(guess, guess_));
    dt_ = dt;
  }
}

void CurvatureProbe::end_solve(bool was_in_doubt) {
  if (is_probing_) {
    patience_ = std::min(2 * patience_, most_patience);
    doubts_ = 0;
  } else if (was_in_doubt) {
    ++doubts_;
  } else {
    doubts_ = 0;
    patience_ = least_patience;
  }
}

void CurvatureProbe::forget() { dt_ = 0; }

/// The kept guess is not saved: another one is kept after the next solve in doubt.
void CurvatureProbe::archive(Archive& archive) {
  archive.item("curvature_probe.doubts", doubts_);
  archive.item("curvature_probe.patience", patience_);
  forget();
}

}   // namespace cablenet::solve

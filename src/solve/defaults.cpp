#include "cablenet/solve/defaults.hpp"

#include <fmt/format.h>

#include "cablenet/base/errors.hpp"
#include "cablenet/petsc/handle.hpp"
#include "cablenet/petsc/queries.hpp"

namespace cablenet::solve {

using petsc::check;
using petsc::has_option;

namespace {

/// Block products a node up to which the elimination is faster than MUMPS: nets of some 60 x 60 meshes
/// (jobs/README.md).
constexpr double default_limit = 600;

/// Block products a node from which factoring costs ten times a solution.
constexpr double dear = 50;

/// A shell would be kept by -snes_mf, too, which means to do without.
bool user_chose_preconditioner() {
  return has_option("-pc_type") || has_option("-pc_factor_mat_solver_type") || has_option("-snes_mf");
}

double elimination_limit() {
  PetscReal limit = default_limit;
  check(PetscOptionsGetReal(nullptr, nullptr, "-cable_elimination_limit", &limit, nullptr));
  if (!(limit >= 0))
    throw InputError(
        fmt::format("-cable_elimination_limit: {} is not allowed; expected block products a node, >= 0", limit));
  return limit;
}

bool has_type(Mat matrix, const char* sequential, const char* distributed) {
  PetscBool matches = PETSC_FALSE;
  check(PetscObjectTypeCompareAny(reinterpret_cast<PetscObject>(matrix), &matches, sequential, distributed, ""));
  return matches == PETSC_TRUE;
}

void use_mumps(PC pc, Mat matrix) {
  constexpr auto ordering = "-mat_mumps_icntl_7", metis = "5";
  check(PCSetType(pc, petsc::is_known_symmetric(matrix) ? PCCHOLESKY : PCLU));
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  if (!has_option(ordering)) check(PetscOptionsSetValue(nullptr, ordering, metis));
}

}   // namespace

LinearSolver configure_linear_solver(KSP ksp, const partition::LocalNetwork& network, Mat matrix) {
  PC pc = nullptr;
  LinearSolver solver;
  check(KSPSetType(ksp, KSPPREONLY));
  check(KSPGetPC(ksp, &pc));
  check(PCSetType(pc, PCLU));
  if (has_type(matrix, MATSEQAIJ, MATMPIAIJ) && !user_chose_preconditioner()) {
    const double limit = elimination_limit();
    solver.elimination = NetworkPc::make(network, matrix, limit);
    if (solver.elimination) {
      solver.factors_are_dear = solver.elimination->updates_per_node() > dear;
      solver.elimination->attach(pc);
      solver.reason = fmt::format("{:.1f} block products a node", solver.elimination->updates_per_node());
    } else {
      use_mumps(pc, matrix);
      solver.factors_are_dear = true;
      solver.reason = fmt::format("elimination would take more than {} block products a node", limit);
    }
  }
  check(KSPSetFromOptions(ksp));
  return solver;
}

void configure_newton(SNES snes, double force_tolerance) {
  SNESLineSearch search = nullptr;
  check(SNESGetLineSearch(snes, &search));
  check(SNESLineSearchSetType(search, SNESLINESEARCHBASIC));
  // A good first guess makes relative tests unreachable, and Newton's first correction may pass through a much larger
  // residual (a turned stiff element is a stretched one), so the divergence test is off.
  check(SNESSetTolerances(snes, force_tolerance, 0, 0, 25, petsc::unlimited));
  check(SNESSetDivergenceTolerance(snes, petsc::unlimited));
}

std::string describe(KSP ksp, const LinearSolver& solver) {
  PC pc = nullptr;
  KSPType ksp_type = nullptr;
  PCType pc_type = nullptr;
  MatSolverType package = nullptr;
  check(KSPGetPC(ksp, &pc));
  check(KSPGetType(ksp, &ksp_type));
  check(PCGetType(pc, &pc_type));
  const std::string kind = pc_type;
  std::string text = fmt::format("{} + {}", ksp_type, kind == PCSHELL ? "network elimination" : kind);
  if (kind == PCLU || kind == PCCHOLESKY) check(PCFactorGetMatSolverType(pc, &package));
  if (package != nullptr) text += fmt::format(" ({})", package);
  return solver.reason.empty() ? text : text + ", " + solver.reason;
}

}   // namespace cablenet::solve

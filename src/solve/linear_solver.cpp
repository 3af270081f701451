#include "cablenet/solve/linear_solver.hpp"

#include <fmt/format.h>

#include <limits>

#include "cablenet/petsc/handle.hpp"
#include "cablenet/petsc/queries.hpp"
#include "cablenet/solve/own_options.hpp"

namespace cablenet::solve {

using petsc::check;

namespace {

/// Block products a node up to which the elimination is faster than MUMPS: nets of some 60 x 60 meshes
/// (jobs/README.md).
constexpr double default_limit = 600;

/// Block products a node from which factoring costs ten times a solution.
constexpr double dear = 50;

const char* prefix_of(KSP ksp) {
  const char* prefix = nullptr;
  check(KSPGetOptionsPrefix(ksp, &prefix));
  return prefix;
}

/// -snes_mf means to do without a preconditioner, but it would keep a PCSHELL.
bool user_chose_preconditioner(const char* prefix) {
  return petsc::has_option("-pc_type", prefix) || petsc::has_option("-pc_factor_mat_solver_type", prefix) ||
         petsc::has_option("-snes_mf", prefix);
}

bool has_type(Mat matrix, const char* sequential, const char* distributed) {
  PetscBool matches = PETSC_FALSE;
  check(PetscObjectTypeCompareAny(reinterpret_cast<PetscObject>(matrix), &matches, sequential, distributed, ""));
  return matches == PETSC_TRUE;
}

}   // namespace

LinearSolver::LinearSolver(KSP ksp, const partition::LocalNetwork& network, Mat matrix) : ksp_(ksp), matrix_(matrix) {
  PC pc = nullptr;
  check(KSPSetOperators(ksp, matrix, matrix));
  check(KSPSetType(ksp, KSPPREONLY));
  check(KSPGetPC(ksp, &pc));
  check(PCSetType(pc, PCLU));
  if (has_type(matrix, MATSEQAIJ, MATMPIAIJ) && !user_chose_preconditioner(prefix_of(ksp)))
    use_elimination_or_mumps(network, pc);
  check(KSPSetFromOptions(ksp));
}

void LinearSolver::use_elimination_or_mumps(const partition::LocalNetwork& network, PC pc) {
  const double limit = read_number(elimination_limit_option, PetscObjectComm(reinterpret_cast<PetscObject>(ksp_)),
                                   prefix_of(ksp_), default_limit, 0, std::numeric_limits<double>::infinity());
  elimination_ = NetworkPc::make(network, matrix_, limit);
  if (elimination_) {
    factors_are_dear_ = elimination_->updates_per_node() > dear;
    elimination_->attach(pc);
    reason_ = fmt::format("{:.1f} block products a node", elimination_->updates_per_node());
    return;
  }
  check(PCSetType(pc, petsc::is_known_symmetric(matrix_) ? PCCHOLESKY : PCLU));
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  factors_are_dear_ = true;
  reason_ = fmt::format("elimination would take more than {} block products a node", limit);
}

std::optional<PivotReport> LinearSolver::pivots() const {
  if (!elimination_) return {};
  return elimination_->pivots();
}

KSPConvergedReason LinearSolver::solve_outside_newton(Mat matrix, Vec right, Vec solution) {
  petsc::Handle<KSP, KSPDestroy> own;
  PC shared = nullptr;
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check(KSPCreate(PetscObjectComm(reinterpret_cast<PetscObject>(ksp_)), own.out()));
  check(KSPGetPC(ksp_, &shared));
  check(KSPSetPC(own, shared));
  check(KSPSetOperators(own, matrix, matrix));
  check(KSPSetType(own, KSPPREONLY));
  check(KSPSetOptionsPrefix(own, prefix_of(ksp_)));
  check(KSPSetFromOptions(own));
  check(KSPSolve(own, right, solution));
  check(KSPGetConvergedReason(own, &reason));
  return reason;
}

void LinearSolver::recover() {
  if (elimination_) return;
  check(KSPReset(ksp_));
  check(KSPSetOperators(ksp_, matrix_, matrix_));
}

std::string LinearSolver::describe() const {
  PC pc = nullptr;
  KSPType ksp_type = nullptr;
  PCType pc_type = nullptr;
  MatSolverType package = nullptr;
  check(KSPGetPC(ksp_, &pc));
  check(KSPGetType(ksp_, &ksp_type));
  check(PCGetType(pc, &pc_type));
  const std::string kind = pc_type;
  std::string text = fmt::format("{} + {}", ksp_type, kind == PCSHELL ? "network elimination" : kind);
  if (kind == PCLU || kind == PCCHOLESKY) check(PCFactorGetMatSolverType(pc, &package));
  if (package != nullptr) text += fmt::format(" ({})", package);
  return reason_.empty() ? text : text + ", " + reason_;
}

}   // namespace cablenet::solve

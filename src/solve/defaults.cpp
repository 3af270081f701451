#include "cablenet/solve/defaults.hpp"

#include "cablenet/petsc/handle.hpp"

namespace cablenet::solve {

using petsc::check;

namespace {

/// Up to here a network counts as nearly a tree.
constexpr int few_loops = 10;

void use_natural_lu(PC pc) {
  check(PCSetType(pc, PCLU));
  check(PCFactorSetMatSolverType(pc, MATSOLVERPETSC));
  check(PCFactorSetMatOrderingType(pc, MATORDERINGNATURAL));
}

}   // namespace

void configure_linear_solver(KSP ksp, int loops) {
  PetscMPIInt ranks = 1;
  MPI_Comm_size(PetscObjectComm(reinterpret_cast<PetscObject>(ksp)), &ranks);
  PC pc = nullptr;
  check(KSPSetType(ksp, KSPPREONLY));
  check(KSPGetPC(ksp, &pc));
  if (ranks == 1) {
    use_natural_lu(pc);
  } else if (loops <= few_loops) {
    KSP inner = nullptr;
    PC inner_pc = nullptr;
    check(PCSetType(pc, PCREDUNDANT));
    check(PCRedundantGetKSP(pc, &inner));
    check(KSPGetPC(inner, &inner_pc));
    use_natural_lu(inner_pc);
  } else {
    check(PCSetType(pc, PCLU));
    check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  }
  check(KSPSetFromOptions(ksp));
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

std::string describe_linear_solver(KSP ksp) {
  PC pc = nullptr;
  KSPType ksp_type = nullptr;
  PCType pc_type = nullptr;
  MatSolverType package = nullptr;
  check(KSPGetPC(ksp, &pc));
  check(KSPGetType(ksp, &ksp_type));
  check(PCGetType(pc, &pc_type));
  std::string text = std::string(ksp_type) + " + " + pc_type;
  const std::string kind = pc_type;
  if (kind == PCLU || kind == PCCHOLESKY) check(PCFactorGetMatSolverType(pc, &package));
  if (kind == PCREDUNDANT) text += " (the whole network on every rank)";
  if (package != nullptr) text += " (" + std::string(package) + ")";
  return text;
}

}   // namespace cablenet::solve

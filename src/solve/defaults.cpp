#include "cablenet/solve/defaults.hpp"

#include <fmt/format.h>

#include <map>

#include "cablenet/petsc/handle.hpp"

namespace cablenet::solve {

using petsc::check;

namespace {

/// Orders that were registered with PETSc, by name: it hands an ordering function nothing else of ours.
std::map<std::string, std::vector<PetscInt>>& registered_orders() {
  static std::map<std::string, std::vector<PetscInt>> orders;
  return orders;
}

PetscErrorCode registered_order(Mat, MatOrderingType name, IS* rows, IS* columns) noexcept {
  PetscFunctionBeginUser;
  const std::vector<PetscInt>& order = registered_orders().at(name);
  for (IS* permutation : {rows, columns}) {
    PetscCall(ISCreateGeneral(PETSC_COMM_SELF, static_cast<PetscInt>(order.size()), order.data(), PETSC_COPY_VALUES,
                              permutation));
    PetscCall(ISSetPermutation(*permutation));
  }
  PetscFunctionReturn(petsc::success);
}

/// The name of a new ordering: three unknowns a node.
std::string register_order(const std::vector<int>& elimination) {
  const std::string name = fmt::format("leaf_to_root_{}", registered_orders().size());
  std::vector<PetscInt>& order = registered_orders()[name];
  order.reserve(3 * elimination.size());
  for (const int node : elimination)
    for (int k = 0; k < 3; ++k) order.push_back(3 * node + k);
  check(MatOrderingRegister(name.c_str(), registered_order));
  return name;
}

void use_lu(PC pc, MatSolverType package, const std::string& ordering) {
  check(PCSetType(pc, PCLU));
  check(PCFactorSetMatSolverType(pc, package));
  if (!ordering.empty()) check(PCFactorSetMatOrderingType(pc, ordering.c_str()));
}

}   // namespace

void configure_linear_solver(KSP ksp, const std::vector<int>& elimination) {
  PetscMPIInt ranks = 1;
  MPI_Comm_size(PetscObjectComm(reinterpret_cast<PetscObject>(ksp)), &ranks);
  PC pc = nullptr;
  check(KSPSetType(ksp, KSPPREONLY));
  check(KSPGetPC(ksp, &pc));
  if (ranks == 1) {
    use_lu(pc, MATSOLVERPETSC, MATORDERINGNATURAL);
  } else if (!elimination.empty()) {
    KSP inner = nullptr;
    PC inner_pc = nullptr;
    check(PCSetType(pc, PCREDUNDANT));
    check(PCRedundantGetKSP(pc, &inner));
    check(KSPGetPC(inner, &inner_pc));
    use_lu(inner_pc, MATSOLVERPETSC, register_order(elimination));
  } else {
    use_lu(pc, MATSOLVERMUMPS, "");
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

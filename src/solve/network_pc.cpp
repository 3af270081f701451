#include "cablenet/solve/network_pc.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "cablenet/petsc/phase.hpp"
#include "network_pc_impl.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;

}   // namespace

PetscErrorCode NetworkPc::Impl::set_up(PC pc) {
  PetscFunctionBeginUser;
  PetscCall(PCSetFailedReason(pc, PC_NOERROR));
  elimination::Arrays arrays = blocks_.values(exchange_.received());
  if (!symmetric_ && !numbers_.empty()) exchange_.run(arrays);
  {
    const petsc::Timer timer(petsc::Phase::factor);
    pivots_ = elimination_->factor(arrays);
  }
  is_singular_ = pivots_.singular >= 0;
  // Where there is an interface, its sum tells all ranks of it.
  if (numbers_.empty() && ranks() > 1) MPI_Allreduce(MPI_IN_PLACE, &is_singular_, 1, MPI_INT, MPI_LOR, communicator_);
  blocks_.release(arrays);
  new_matrix_ = true;
  PetscFunctionReturn(petsc::success);
}

void NetworkPc::Impl::add_to_interface(const double* b) {
  interface_->clear(new_matrix_);
  if (is_singular_) interface_->add_failure();
  const auto add_right_side = [this](InterfaceNode node, const double* values) {
    double* const to = interface_->right_side(node);
    for (int c = 0; c < interface_->size(node); ++c) to[c] += *values++;
    return values;
  };
  const double* from_interior = kept_values_.data();
  for (const InterfaceNode node : kept_) from_interior = add_right_side(node, from_interior);
  const double* own = b + interior_unknowns();
  for (const InterfaceNode node : own_interface_) own = add_right_side(node, own);
  if (!new_matrix_) return;
  elimination::Arrays arrays = blocks_.values(nullptr);
  for (const auto& [from, to] : own_shares_) interface_->add(to, arrays[from.array] + from.offset, from.stride, false);
  blocks_.release(arrays);
  for (const auto& [values, stride, to, transposed] : left_shares_) interface_->add(to, values, stride, transposed);
}

/// @returns false if the matrix is singular
bool NetworkPc::Impl::solve(const double* b, double* x) {
  if (numbers_.empty() && is_singular_) return false;
  std::optional<petsc::Timer> timer(petsc::Phase::solve);
  std::copy_n(b, interior_unknowns(), x);
  std::fill(kept_values_.begin(), kept_values_.end(), 0.0);
  if (!is_singular_) elimination_->forward(x, kept_values_.data());
  if (!numbers_.empty()) {
    add_to_interface(b);
    timer.reset();
    if (!interface_->solve()) return false;
    timer.emplace(petsc::Phase::solve);
    new_matrix_ = false;
    double* to_interior = kept_values_.data();
    for (const InterfaceNode node : kept_)
      to_interior = std::copy_n(interface_->solution(node), interface_->size(node), to_interior);
    double* own = x + interior_unknowns();
    for (const InterfaceNode node : own_interface_)
      own = std::copy_n(interface_->solution(node), interface_->size(node), own);
  }
  elimination_->backward(x, kept_values_.data());
  return true;
}

PetscErrorCode NetworkPc::Impl::apply(PC pc, Vec b, Vec x) {
  PetscFunctionBeginUser;
  const double* from = nullptr;
  double* to = nullptr;
  PetscCall(VecGetArrayRead(b, &from));
  PetscCall(VecGetArrayWrite(x, &to));
  if (!solve(from, to)) {
    // Some Krylov methods learn of a failure only by the norm of what they get.
    std::fill_n(to, blocks_.begin(blocks_.rows()), std::numeric_limits<double>::infinity());
    PetscCall(PCSetFailedReason(pc, PC_FACTOR_NUMERIC_ZEROPIVOT));
  }
  PetscCall(VecRestoreArrayWrite(x, &to));
  PetscCall(VecRestoreArrayRead(b, &from));
  PetscFunctionReturn(petsc::success);
}

PivotReport NetworkPc::Impl::pivots() const {
  long found[2] = {pivots_.singular < 0 ? -1 : number(pivots_.singular).value(), 0};
  MPI_Allreduce(MPI_IN_PLACE, &found[0], 1, MPI_LONG, MPI_MAX, communicator_);
  const long inside = pivots_.negative + elimination_->negative_in_bodies();
  MPI_Allreduce(&inside, &found[1], 1, MPI_LONG, MPI_SUM, communicator_);
  const elimination::Pivots shared = interface_->pivots();
  if (found[0] < 0 && shared.singular >= 0) found[0] = numbers_[at(shared.singular)].value();
  return {SolverNumber(static_cast<int>(found[0])), found[1] + shared.negative};
}

NetworkPc::NetworkPc(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
NetworkPc::~NetworkPc() = default;

std::unique_ptr<NetworkPc> NetworkPc::make(const partition::LocalNetwork& network, Mat matrix, double most_per_node) {
  auto impl = std::make_unique<Impl>(network, matrix);
  if (!impl->plan(network, most_per_node)) return nullptr;
  return std::unique_ptr<NetworkPc>(new NetworkPc(std::move(impl)));
}

void NetworkPc::attach(PC pc) {
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetName(pc, "network elimination"));
  check(PCSetApplicationContext(pc, impl_.get()));
  check(PCShellSetSetUp(pc, [](PC shell) noexcept -> PetscErrorCode {
    void* impl = nullptr;
    PetscCall(PCGetApplicationContext(shell, &impl));
    return static_cast<Impl*>(impl)->set_up(shell);
  }));
  check(PCShellSetApply(pc, [](PC shell, Vec b, Vec x) noexcept -> PetscErrorCode {
    void* impl = nullptr;
    PetscCall(PCGetApplicationContext(shell, &impl));
    return static_cast<Impl*>(impl)->apply(shell, b, x);
  }));
}

double NetworkPc::updates_per_node() const { return impl_->updates_per_node(); }
PivotReport NetworkPc::pivots() const { return impl_->pivots(); }

}   // namespace cablenet::solve

#include "cablenet/solve/network_pc.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <unordered_map>

#include "cablenet/petsc/handle.hpp"
#include "cablenet/petsc/phase.hpp"
#include "coupling_exchange.hpp"
#include "interface_system.hpp"
#include "matrix_blocks.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;

std::size_t at(int index) { return static_cast<std::size_t>(index); }

}   // namespace

/// Local blocks: the interior nodes, then the interface nodes at them (`kept_`, by their places in the interface).
class NetworkPc::Impl {
public:
  Impl(const partition::LocalNetwork& network, Mat matrix)
      : matrix_(matrix),
        communicator_(PetscObjectComm(reinterpret_cast<PetscObject>(matrix))),
        blocks_(matrix),
        interior_(network.interior),
        numbers_(network.interface.number),
        exchange_(communicator_) {
    for (std::size_t i = 0; i < numbers_.size(); ++i) place_[numbers_[i]] = static_cast<int>(i);
    PetscBool known = PETSC_FALSE, flag = PETSC_FALSE;
    check(MatIsSymmetricKnown(matrix, &known, &flag));
    symmetric_ = known == PETSC_TRUE && flag == PETSC_TRUE;
  }

  bool plan(const partition::LocalNetwork& network, double most_per_node);
  PetscErrorCode set_up(PC pc);
  PetscErrorCode apply(PC pc, Vec b, Vec x);
  double updates_per_node() const;
  PivotReport pivots() const;

private:
  elimination::Pattern pattern();
  void find_couplings();
  elimination::BlockSource source(int row, int column);
  int owner(int number) const;
  int ranks() const {
    int count = 1;
    MPI_Comm_size(communicator_, &count);
    return count;
  }
  int number(int local) const {
    return local < interior_ ? blocks_.first() + local : numbers_[at(kept_[at(local - interior_)])];
  }
  void add_to_interface(const double* b);
  bool solve(const double* b, double* x);

  Mat matrix_;
  MPI_Comm communicator_;
  MatrixBlocks blocks_;
  int interior_;
  std::vector<int> numbers_;             ///< of the interface nodes
  std::unordered_map<int, int> place_;   ///< in numbers_
  std::vector<int> kept_;
  bool symmetric_ = false;
  bool new_matrix_ = false;
  CouplingExchange exchange_;
  std::unique_ptr<elimination::Elimination> elimination_;
  std::unique_ptr<InterfaceSystem> interface_;
  elimination::Pivots pivots_;
  std::vector<double> kept_values_;
};

elimination::Pattern NetworkPc::Impl::pattern() {
  std::set<int> touched;
  const auto place = [this](int column) {
    const auto found = place_.find(column);
    if (found == place_.end()) throw petsc::Failure("two ranks' interiors are coupled in the matrix");
    return found->second;
  };
  const auto is_interior = [this](int column) {
    return blocks_.is_own(column) && column - blocks_.first() < interior_;
  };
  for (int k = 0; k < interior_; ++k)
    blocks_.for_each(k, [&](int column, const auto&) {
      if (!is_interior(column)) touched.insert(place(column));
    });
  kept_.assign(touched.begin(), touched.end());
  const auto local = [&](int column) {
    if (is_interior(column)) return column - blocks_.first();
    return interior_ + static_cast<int>(std::lower_bound(kept_.begin(), kept_.end(), place(column)) - kept_.begin());
  };
  elimination::Pattern pattern{std::vector<int>(at(interior_) + kept_.size(), 3), interior_, {0}, {}};
  for (int k = 0; k < interior_; ++k) {
    blocks_.for_each(k, [&](int column, const auto&) { pattern.adjacent.push_back(local(column)); });
    pattern.first.push_back(static_cast<int>(pattern.adjacent.size()));
  }
  return pattern;
}

/// The rank that has a node's row.
int NetworkPc::Impl::owner(int number) const {
  const PetscInt* ranges = nullptr;
  check(MatGetOwnershipRanges(matrix_, &ranges));
  return static_cast<int>(std::upper_bound(ranges, ranges + ranks() + 1, PetscInt{3 * number}) - ranges) - 1;
}

/// Blocks (interface node, interior node) stand in the interface node's row, perhaps on another rank.
void NetworkPc::Impl::find_couplings() {
  for (int row = 0; row < blocks_.rows(); ++row)
    blocks_.for_each(row, [&](int column, const elimination::BlockSource& source) {
      if (blocks_.is_own(column)) return;
      if (row < interior_)
        exchange_.add_receive(owner(column), column, blocks_.first() + row);
      else if (!place_.contains(column))
        exchange_.add_send(owner(column), blocks_.first() + row, column, source);
    });
  exchange_.settle();
}

elimination::BlockSource NetworkPc::Impl::source(int row, int column) {
  const int i = number(row), j = number(column);
  if (blocks_.is_own(i)) return blocks_.find(i - blocks_.first(), j);
  elimination::BlockSource mirror = blocks_.find(j - blocks_.first(), i);
  if (mirror.absent) return mirror;
  if (!symmetric_) return exchange_.source(owner(i), i, j);
  mirror.transposed = 1;
  return mirror;
}

bool NetworkPc::Impl::plan(const partition::LocalNetwork& network, double most_per_node) {
  // The interface is every rank's work.
  const double most_updates = most_per_node * std::max(1, network.free_nodes / std::max(1, ranks()));
  auto own = elimination::make_schedule(pattern(), symmetric_, most_updates);
  auto shared = elimination::make_schedule(InterfaceSystem::pattern(network.interface), symmetric_, most_updates);
  int possible = own && shared && own->updates + shared->updates <= most_updates;
  MPI_Allreduce(MPI_IN_PLACE, &possible, 1, MPI_INT, MPI_LAND, communicator_);
  if (!possible) return false;
  if (!symmetric_) find_couplings();
  elimination_ =
      std::make_unique<elimination::Elimination>(std::move(*own), [this](int i, int j) { return source(i, j); });
  interface_ = std::make_unique<InterfaceSystem>(network.interface, std::move(*shared), communicator_);
  kept_values_.resize(3 * kept_.size());
  return true;
}

PetscErrorCode NetworkPc::Impl::set_up(PC pc) {
  PetscFunctionBeginUser;
  PetscCall(PCSetFailedReason(pc, PC_NOERROR));
  elimination::Arrays arrays = blocks_.values(exchange_.received());
  if (!symmetric_ && !numbers_.empty()) exchange_.run(arrays);
  {
    const petsc::Timer timer(petsc::Phase::factor);
    pivots_ = elimination_->factor(arrays);
  }
  blocks_.release(arrays);
  new_matrix_ = true;
  PetscFunctionReturn(petsc::success);
}

void NetworkPc::Impl::add_to_interface(const double* b) {
  interface_->clear(new_matrix_);
  if (pivots_.singular >= 0) interface_->add_failure();
  const auto add_right_side = [this](int node, const double* values) {
    for (std::size_t c = 0; c < 3; ++c) interface_->right_side(node)[c] += values[c];
  };
  for (std::size_t i = 0; i < kept_.size(); ++i) add_right_side(kept_[i], kept_values_.data() + 3 * i);
  for (int row = interior_; row < blocks_.rows(); ++row)
    add_right_side(place_.at(blocks_.first() + row), b + 3 * std::ptrdiff_t{row});
  if (!new_matrix_) return;
  elimination::Arrays arrays = blocks_.values(nullptr);
  for (int row = interior_; row < blocks_.rows(); ++row)
    blocks_.for_each(row, [&](int column, const elimination::BlockSource& from) {
      if (const auto found = place_.find(column); found != place_.end())
        interface_->add(place_.at(blocks_.first() + row), found->second, arrays[from.array] + from.offset, from.stride,
                        false);
    });
  blocks_.release(arrays);
  for (const auto& block : elimination_->schedule().kept) {
    const int row = kept_[at(block.row - interior_)], column = kept_[at(block.column - interior_)];
    interface_->add(row, column, elimination_->update(block), 3, false);
    if (symmetric_ && row != column) interface_->add(column, row, elimination_->update(block), 3, true);
  }
}

/// @returns false if the matrix is singular
bool NetworkPc::Impl::solve(const double* b, double* x) {
  if (numbers_.empty() && pivots_.singular >= 0) return false;
  std::optional<petsc::Timer> timer(petsc::Phase::solve);
  std::copy_n(b, 3 * std::ptrdiff_t{interior_}, x);
  std::fill(kept_values_.begin(), kept_values_.end(), 0.0);
  if (pivots_.singular < 0) elimination_->forward(x, kept_values_.data());
  if (!numbers_.empty()) {
    add_to_interface(b);
    timer.reset();
    if (!interface_->solve()) return false;
    timer.emplace(petsc::Phase::solve);
    new_matrix_ = false;
    for (std::size_t i = 0; i < kept_.size(); ++i)
      std::copy_n(interface_->solution(kept_[i]), 3, kept_values_.data() + 3 * i);
    for (int row = interior_; row < blocks_.rows(); ++row)
      std::copy_n(interface_->solution(place_.at(blocks_.first() + row)), 3, x + 3 * std::ptrdiff_t{row});
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
  if (!solve(from, to)) PetscCall(PCSetFailedReason(pc, PC_FACTOR_NUMERIC_ZEROPIVOT));
  PetscCall(VecRestoreArrayWrite(x, &to));
  PetscCall(VecRestoreArrayRead(b, &from));
  PetscFunctionReturn(petsc::success);
}

double NetworkPc::Impl::updates_per_node() const {
  double mine = elimination_->schedule().updates / std::max(1, elimination_->schedule().eliminated());
  MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_DOUBLE, MPI_MAX, communicator_);
  return mine;
}

PivotReport NetworkPc::Impl::pivots() const {
  long found[2] = {pivots_.singular < 0 ? -1 : number(pivots_.singular), 0};
  MPI_Allreduce(MPI_IN_PLACE, &found[0], 1, MPI_LONG, MPI_MAX, communicator_);
  const long inside = pivots_.negative;
  MPI_Allreduce(&inside, &found[1], 1, MPI_LONG, MPI_SUM, communicator_);
  const elimination::Pivots& shared = interface_->pivots();
  if (found[0] < 0 && shared.singular >= 0) found[0] = numbers_[at(shared.singular)];
  return {static_cast<int>(found[0]), found[1] + shared.negative};
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
  check(PCShellSetContext(pc, impl_.get()));
  check(PCShellSetSetUp(pc, [](PC shell) -> PetscErrorCode {
    void* impl = nullptr;
    PetscCall(PCShellGetContext(shell, &impl));
    return static_cast<Impl*>(impl)->set_up(shell);
  }));
  check(PCShellSetApply(pc, [](PC shell, Vec b, Vec x) -> PetscErrorCode {
    void* impl = nullptr;
    PetscCall(PCShellGetContext(shell, &impl));
    return static_cast<Impl*>(impl)->apply(shell, b, x);
  }));
}

double NetworkPc::updates_per_node() const { return impl_->updates_per_node(); }
PivotReport NetworkPc::pivots() const { return impl_->pivots(); }

}   // namespace cablenet::solve

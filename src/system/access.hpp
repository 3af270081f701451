#pragma once
#include <algorithm>
#include <utility>

#include "cablenet/system/assembler.hpp"
#include "element_loop.hpp"

namespace cablenet::system {

/// The arrays of the solver's vectors, open for the time of one evaluation; r is cleared, those not given stay null.
struct Assembler::Access {
  Access(Assembler& assembler, Vec x, Vec v, Vec a, Vec r) : assembler_(assembler), x_(x), v_(v), a_(a), r_(r) {
    using petsc::check;
    data.owned = assembler.network_.owned;
    data.begin = assembler.network_.begin.data();
    data.ghost_rotations = assembler.ghost_rotations_.data();
    data.outside = assembler.outside_.data();
    data.outside_r = assembler.outside_r_.data();
    check(VecGetArrayRead(x_, &data.x));
    check(VecGetArrayRead(v_, &data.v));
    if (a_ != nullptr) check(VecGetArrayRead(a_, &data.a));
    if (r_ == nullptr) return;
    check(VecGetArrayWrite(r_, &data.r));
    std::fill_n(data.r, assembler.network_.unknowns(), 0.0);
    std::fill(assembler.outside_r_.begin(), assembler.outside_r_.end(), 0.0);
  }
  Access(const Access&) = delete;
  Access& operator=(const Access&) = delete;
  ~Access() { close(); }

  void begin_exchange() {
    assembler_.ghosts_.begin(data.x, data.v, data.a, data.outside, data.ghost_rotations);
    exchanging_ = true;
  }
  void finish_exchange() {
    if (exchanging_) assembler_.ghosts_.end();
    exchanging_ = false;
  }
  void close() {
    if (std::exchange(closed_, true)) return;
    finish_exchange();
    if (x_ != nullptr) (void)VecRestoreArrayRead(x_, &data.x);
    if (v_ != nullptr) (void)VecRestoreArrayRead(v_, &data.v);
    if (a_ != nullptr) (void)VecRestoreArrayRead(a_, &data.a);
    if (r_ != nullptr) (void)VecRestoreArrayWrite(r_, &data.r);
  }

  /// A rank without nodes has no array but takes part.
  bool has_residual() const { return r_ != nullptr; }

  NodeData data{};

private:
  Assembler& assembler_;
  Vec x_, v_, a_, r_;
  bool exchanging_ = false;
  bool closed_ = false;
};

}   // namespace cablenet::system

#pragma once
#include <petscvec.h>

#include "cablenet/petsc/handle.hpp"

namespace cablenet::petsc {

/// The values of this rank's part of a vector, open while this lives.  No vector has no values.
template <class T, auto get, auto restore>
class OpenValues {
public:
  explicit OpenValues(Vec vector) : vector_(vector) {
    if (vector_ != nullptr) check(get(vector_, &values_));
  }
  ~OpenValues() {
    if (vector_ != nullptr) (void)restore(vector_, &values_);
  }
  OpenValues(const OpenValues&) = delete;
  OpenValues& operator=(const OpenValues&) = delete;
  operator T*() const { return values_; }

private:
  Vec vector_;
  T* values_ = nullptr;
};

using ReadValues = OpenValues<const double, VecGetArrayRead, VecRestoreArrayRead>;
using ChangedValues = OpenValues<double, VecGetArray, VecRestoreArray>;
/// All of them are written; what they were is of no use.
using WrittenValues = OpenValues<double, VecGetArrayWrite, VecRestoreArrayWrite>;

}   // namespace cablenet::petsc

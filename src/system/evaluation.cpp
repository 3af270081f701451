#include "evaluation.hpp"

#include <algorithm>

#include "body_term.hpp"

namespace cablenet::system {

using petsc::check;

OutsideNodes::OutsideNodes(const partition::LocalNetwork& network)
    : motion(at(network.nodes - network.owned)),
      forces(3 * at(network.nodes - network.owned)),
      ghost_rotations(at(network.ghosts)) {}

OpenVectors::OpenVectors(const partition::LocalNetwork& network, OutsideNodes& outside, Vec x, Vec v, Vec a, Vec r)
    : x_(x), v_(v), a_(a), r_(r) {
  data_.owned = network.owned;
  data_.begin = network.begin.data();
  data_.outside = outside.motion.data();
  data_.outside_r = outside.forces.data();
  data_.ghost_rotations = outside.ghost_rotations.data();
  check(VecGetArrayRead(x_, &data_.x));
  check(VecGetArrayRead(v_, &data_.v));
  if (a_ != nullptr) check(VecGetArrayRead(a_, &data_.a));
  if (r_ == nullptr) return;
  check(VecGetArrayWrite(r_, &data_.r));
  std::fill_n(data_.r, network.unknowns(), 0.0);
  std::fill(outside.forces.begin(), outside.forces.end(), 0.0);
}

OpenVectors::~OpenVectors() {
  (void)VecRestoreArrayRead(x_, &data_.x);
  (void)VecRestoreArrayRead(v_, &data_.v);
  if (a_ != nullptr) (void)VecRestoreArrayRead(a_, &data_.a);
  if (r_ != nullptr) (void)VecRestoreArrayWrite(r_, &data_.r);
}

void Evaluation::complete() {
  if (std::exchange(is_complete, true)) return;
  if (is_exchanging) exchange.end();
  bodies.carry(*this);
}

}   // namespace cablenet::system

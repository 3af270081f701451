#include "evaluation.hpp"

#include <algorithm>

#include "body_term.hpp"

namespace cablenet::system {

OutsideNodes::OutsideNodes(const partition::LocalNetwork& network)
    : motion(at(network.nodes - network.owned), {Vector3::Zero(), Vector3::Zero(), Vector3::Zero()}),
      forces(3 * motion.size()),
      ghost_rotations(at(network.ghosts)) {}

OpenVectors::OpenVectors(const partition::LocalNetwork& network, OutsideNodes& outside, Vec in_x, Vec in_v, Vec in_a,
                         Vec in_r)
    : x(in_x),
      v(in_v),
      a(in_a),
      r(in_r),
      data{network.owned,         network.begin.data(),          x, v, a, r, outside.motion.data(),
           outside.forces.data(), outside.ghost_rotations.data()} {
  if (data.r == nullptr) return;
  std::fill_n(data.r, network.unknowns(), 0.0);
  std::fill(outside.forces.begin(), outside.forces.end(), 0.0);
}

void Evaluation::complete() {
  if (std::exchange(is_complete, true)) return;
  if (is_exchanging) exchange.end();
  bodies.carry(*this);
}

}   // namespace cablenet::system

#pragma once
#include "cablenet/solve/observers.hpp"
#include "cablenet/system/assembler.hpp"

namespace cablenet::solve {

/// What is known of a failure besides its residual.  Numbers in network::Network, -1: none.
struct KnownFailure {
  SolverNumber singular_node;
  int outside_element = -1;   ///< that lost its length
  int outside_body = -1;      ///< that turned out of its domain
};

/// Where, on any rank, a residual is worst or undefined.  Collective.
FailedPart worst_part(const system::Assembler& assembler, Vec residual, const KnownFailure& known);

}   // namespace cablenet::solve

#include "failed_part.hpp"

#include <cmath>

#include "cablenet/bodies/rigid_body.hpp"

namespace cablenet::solve {
namespace {

using petsc::check;

/// The size of a residual that is undefined, or where the tangent is singular: larger than any other.
constexpr double unnatural = 1e300;

}   // namespace

FailedPart worst_part(const system::Assembler& assembler, Vec residual, const KnownFailure& known) {
  const auto& network = assembler.network();
  const double* values = nullptr;
  check(VecGetArrayRead(residual, &values));
  // MPI_MAXLOC carries one number: that of an element, or -1 minus that of a body.
  struct {
    double size;
    int part;
  } worst{-1, 0};
  const auto look_at = [&](LocalNode node, int unknowns, int part) {
    if (!network.is_owned(node)) return;
    double size = Eigen::Map<const Eigen::VectorXd>(values + network.begin[node].value(), unknowns).norm();
    if (!std::isfinite(size) || network.number(node) == known.singular_node) size = unnatural;
    if (size > worst.size) worst = {size, part};
  };
  for (std::size_t i = 0; i < network.elements.size(); ++i)
    for (const LocalNode node : network.elements[i].node) look_at(node, 3, network.scene_element[i]);
  for (const auto& body : network.bodies)
    look_at(body.node, 3 + bodies::rotation_unknowns(body.properties.rotation), -1 - body.body);
  check(VecRestoreArrayRead(residual, &values));
  if (known.outside_element >= 0) worst = {2 * unnatural, known.outside_element};
  if (known.outside_body >= 0) worst = {3 * unnatural, -1 - known.outside_body};
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE_INT, MPI_MAXLOC, assembler.communicator());
  if (worst.part >= 0) return {worst.part, -1, false};
  return {-1, -1 - worst.part, worst.size > 2 * unnatural};
}

}   // namespace cablenet::solve

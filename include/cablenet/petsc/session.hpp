#pragma once
#include <string>
#include <vector>

namespace cablenet::petsc {

/// PETSc and MPI from construction to destruction; first in main, so that every Handle dies before PetscFinalize.
/// Collective.
class Session {
public:
  /// @param program argv[0]   @param options PETSc options as on a command line
  Session(const std::string& program, const std::vector<std::string>& options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

}   // namespace cablenet::petsc

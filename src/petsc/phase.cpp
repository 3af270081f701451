#include "cablenet/petsc/phase.hpp"

#include <petscsys.h>

#include <array>
#include <utility>

#include "cablenet/petsc/handle.hpp"

namespace cablenet::petsc {
namespace {

constexpr std::array names{"CableExchange", "CableResidual", "CableTangent", "CableFactor", "CableSolve"};

std::array<PetscLogEvent, names.size()> events{};

}   // namespace

void register_phases() {
  static bool done = false;
  if (std::exchange(done, true)) return;
  PetscClassId cables = 0;
  check(PetscClassIdRegister("Cables", &cables));
  for (std::size_t i = 0; i < names.size(); ++i) check(PetscLogEventRegister(names[i], cables, &events[i]));
}

Timer::Timer(Phase phase) : event_(events[static_cast<std::size_t>(phase)]) {
  (void)PetscLogEventBegin(event_, nullptr, nullptr, nullptr, nullptr);
}

Timer::~Timer() { (void)PetscLogEventEnd(event_, nullptr, nullptr, nullptr, nullptr); }

}   // namespace cablenet::petsc

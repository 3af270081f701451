#pragma once
#include <petscts.h>

#include "cablenet/petsc/handle.hpp"

namespace cablenet::solve {

/// The parameters of the generalised-alpha method as TSALPHA2 has them now.
struct AlphaParameters {
  PetscReal alpha_m, alpha_f, gamma, beta;
};

inline AlphaParameters alpha_parameters(TS ts) {
  AlphaParameters p{};
  petsc::check(TSAlpha2GetParams(ts, &p.alpha_m, &p.alpha_f, &p.gamma, &p.beta));
  return p;
}

}   // namespace cablenet::solve

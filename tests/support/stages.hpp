#pragma once
#include <algorithm>

#include "networks.hpp"

/// Tests compare tangents with differences of residuals, at a state within a step.
namespace cablenet::test {

/// base + scale * noise, the same on any number of ranks.
inline system::Vector shifted(const System& system, Vec base, double scale, int seed) {
  const partition::LocalNetwork& network = system.assembler.network();
  system::Vector result = system.assembler.make_vector();
  petsc::check(VecCopy(base, result));
  double* array = nullptr;
  petsc::check(VecGetArray(result, &array));
  for (LocalNode node(0); network.is_owned(node); ++node) {
    const int begin = network.begin[node].value(), end = network.begin[node + 1].value();
    for (int k = begin; k < end; ++k)
      array[k] += scale * noise(seed + 10 * network.scene_node[node].value() + k - begin);
  }
  petsc::check(VecRestoreArray(result, &array));
  return result;
}

/// A stage near the drawn state, and the shifts dv/dx and da/dx of TSALPHA2.
struct Stages {
  /// @param radius  rho_infinity of the generalised-alpha method
  Stages(const System& system, double radius, double dt = 0.02, double t = 0.1) : stage{t, dt, 1 / (1 + radius)} {
    const double alpha_m = (2 - radius) / (1 + radius), spread = 1 + alpha_m - stage.alpha_f;
    const double gamma = 0.5 + alpha_m - stage.alpha_f, beta = 0.25 * spread * spread;
    shift_v = gamma / (beta * dt);
    shift_a = alpha_m / (stage.alpha_f * beta * dt * dt);
    x0 = system.assembler.make_vector();
    v0 = system.assembler.make_vector();
    system.assembler.fill_initial(x0, v0);
    x = shifted(system, x0, 0.02, 100);
    v = shifted(system, v0, 0.3, 200);
    a = shifted(system, v0, 3, 300);
    direction = shifted(system, v0, 1, 400);
    petsc::check(VecAXPY(direction, -1, v0));
  }

  system::Stage stage;
  double shift_v, shift_a, shift_x = 1;
  bool is_calm = false;   ///< as in system::Situation
  system::Vector x0, v0, x, v, a, direction;
};

inline system::Vector residual_at(System& system, const Stages& s, double step) {
  const system::Vector x = system.assembler.make_vector(), v = system.assembler.make_vector();
  const system::Vector a = system.assembler.make_vector();
  system::Vector r = system.assembler.make_vector();
  petsc::check(VecWAXPY(x, step * s.shift_x, s.direction, s.x));
  petsc::check(VecWAXPY(v, step * s.shift_v, s.direction, s.v));
  petsc::check(VecWAXPY(a, step * s.shift_a, s.direction, s.a));
  EXPECT_TRUE(system.assembler.evaluate({.stage = s.stage, .is_calm = s.is_calm}, x, v, a, r, nullptr));
  return r;
}

/// The central difference of the residual along s.direction.
inline system::Vector slope(System& system, const Stages& s, double h) {
  system::Vector plus = residual_at(system, s, h);
  const system::Vector minus = residual_at(system, s, -h);
  petsc::check(VecAXPY(plus, -1, minus));
  petsc::check(VecScale(plus, 1 / (2 * h)));
  return plus;
}

/// A published tangent times s.direction.
inline system::Vector times_direction(const System& system, const Stages& s, const system::TangentMatrix& tangent) {
  system::Vector product = system.assembler.make_vector();
  petsc::check(MatMult(tangent.matrix(), s.direction, product));
  return product;
}

inline double largest(Vec vector) {
  PetscReal size = 0;
  petsc::check(VecNorm(vector, NORM_INFINITY, &size));
  return size;
}

/// The largest difference of two vectors over the largest value of `expected`.
inline double relative_difference(Vec found, Vec expected) {
  system::Vector difference;
  petsc::check(VecDuplicate(found, difference.out()));
  petsc::check(VecWAXPY(difference, -1, expected, found));
  return largest(difference) / largest(expected);
}

/// All unknowns in the scene's numbering, on every rank.  Collective.
inline std::vector<double> everywhere(const System& system, Vec vector) {
  constexpr std::size_t most = 7;
  const partition::LocalNetwork& network = system.assembler.network();
  std::vector<double> all(most * at(system.network.position.size()), 0.0);
  const double* array = nullptr;
  petsc::check(VecGetArrayRead(vector, &array));
  for (LocalNode node(0); network.is_owned(node); ++node)
    std::copy(array + network.begin[node].value(), array + network.begin[node + 1].value(),
              all.data() + most * at(network.scene_node[node]));
  petsc::check(VecRestoreArrayRead(vector, &array));
  MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM,
                system.assembler.communicator());
  return all;
}

}   // namespace cablenet::test

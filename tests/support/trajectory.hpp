#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cablenet/solve/dynamics.hpp"
#include "networks.hpp"

namespace cablenet::test {

/// A run, and what its observers were told.
class Trajectory {
public:
  Trajectory(const std::string& text, const scene::Time& time, double interval, MPI_Comm communicator)
      : Trajectory(network_of(text), time, interval, communicator) {}
  Trajectory(const network::Network& network, const scene::Time& time, double interval, MPI_Comm communicator)
      : system_(network, {time.scheme, time.axial_dissipation, elements::Tangent::exact}, communicator),
        dynamics_(system_.assembler, time, {interval}) {
    verdict = dynamics_.run({[this](const solve::Instant& instant) { observe(instant); },
                             [this](double t, double dt, const solve::Counts&) { note(t, dt); }});
  }

  solve::Dynamics& dynamics() { return dynamics_; }
  const solve::Counts& counts() const { return dynamics_.counts(); }
  const network::Network& network() const { return system_.network; }

  solve::Verdict verdict;
  Field x, v, a;                           ///< at the last output
  std::vector<system::BodyState> bodies;   ///< of this rank, at the last output
  std::vector<double> outputs;             ///< times
  std::vector<double> steps;               ///< lengths
  std::vector<double> energies;            ///< total at outputs

private:
  void observe(const solve::Instant& instant) {
    EXPECT_DOUBLE_EQ(instant.t, outputs.empty() ? 0 : reached_);
    EXPECT_EQ(instant.step, static_cast<long>(steps.size()));
    outputs.push_back(instant.t);
    x = system_.field(instant.x);
    v = system_.field(instant.v);
    a = system_.field(instant.a);
    bodies = system_.assembler.observe(instant.t, instant.x, instant.v, instant.a).bodies;
    energies.push_back(sum_over_ranks(system_.assembler.energies().total(), system_.assembler.communicator()));
  }
  void note(double t, double dt) {
    EXPECT_NEAR(t, reached_ + dt, 1e-12);
    reached_ = t;
    steps.push_back(dt);
  }

  double reached_ = 0;
  System system_;
  solve::Dynamics dynamics_;
};

}   // namespace cablenet::test

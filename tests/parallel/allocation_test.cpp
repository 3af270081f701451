#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "../support/networks.hpp"
#include "../support/scenes.hpp"
#include "cablenet/solve/dynamics.hpp"

using namespace cablenet;
using namespace cablenet::test;
using scene::Scheme;

namespace {

long allocations = 0;

}   // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

/// The number of allocations in each step of a run.
std::vector<long> allocations_per_step(const std::string& text, Scheme scheme) {
  const network::Network network = network_of(text);
  System system(network, {scheme, 0, elements::Tangent::exact}, PETSC_COMM_WORLD);
  solve::Dynamics::Settings settings{1};
  settings.takes_notes = true;
  solve::Dynamics dynamics(system.assembler, {0, 0.02, 1e-3, scheme, 1, 0}, settings);
  std::vector<long> counts;
  counts.reserve(100);
  dynamics.run(
      {[](const solve::Instant&) {}, [&](double, double, const solve::Counts&) { counts.push_back(allocations); }});
  for (std::size_t i = counts.size() - 1; i > 0; --i) counts[i] -= counts[i - 1];
  return counts;
}

}   // namespace

TEST(Allocations, AStepMakesNone) {
  for (const std::string& text : {chain, array, net})
    for (const Scheme scheme : {Scheme::energy_momentum, Scheme::generalized_alpha, Scheme::plain}) {
      const std::vector<long> counts = allocations_per_step(text, scheme);
      ASSERT_GE(counts.size(), 20u);
      EXPECT_GT(counts[0], 0) << "the counter does not count";
      for (std::size_t i = 1; i < counts.size(); ++i) EXPECT_EQ(counts[i], 0) << "in step " << i + 1;
    }
}

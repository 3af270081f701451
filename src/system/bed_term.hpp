#pragma once
#include "term.hpp"

namespace cablenet::system {

/// Contact of cables with the bed and friction on it.  Tests: tests/parallel/surroundings_test.cpp
class BedTerm : public Term {
public:
  static constexpr Account account = Account::bed;
  using Term::Term;

  bool has_rates() const { return network_.surroundings.bed.has_value(); }
  bool is_symmetric(const ForceRule&) const { return !has_rates(); }
  void add(Evaluation& evaluation);
  void add_potential(const Situation& situation, const LocalState& state, double& sum) const;
  void add_scales(const LocalState&, ForceSums& sums) const;
  Vector3 end_force(const LocalState& state, int element, std::size_t end) const;
};

}   // namespace cablenet::system

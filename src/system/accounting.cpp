#include "assembler_parts.hpp"

/// The assembler's part in the energy accounts: it evaluates groups of terms alone.
namespace cablenet::system {
namespace {

/// Forces at the stage of the last residual.  @tparam Parts  the assembler's
template <class Parts>
class StageForces {
public:
  StageForces(const partition::LocalNetwork& network, const ForceRule& rule, Parts& parts, const Stage& stage)
      : network_(network), rule_(rule), parts_(parts), situation_{.stage = stage} {}

  /// Of the terms that `add` calls.
  template <class Add>
  StepWork work(Add&& add) {
    const auto& [x, v, a] = parts_.last_residual;
    const OpenVectors vectors(network_, parts_.outside, x, v, a, parts_.accounts->scratch());
    const NodeData& data = vectors.data;
    Evaluation evaluation{
        network_, data, situation_, rule_, parts_.exchange, parts_.bodies(), parts_.bodies().carried()};
    evaluation.has_residual = true;
    evaluation.is_exchanging = !std::exchange(has_exchanged_, true);
    if (evaluation.is_exchanging) {
      parts_.exchange.begin(data.x, data.v, data.a, data.outside, data.ghost_rotations);
      parts_.prescribed.place(situation_, rule_.has_mean_acceleration(), data.outside);
    }
    add(evaluation);
    evaluation.complete();
    return parts_.accounts->work(data);
  }

  /// Of the terms of an account.
  template <Account account>
  StepWork work() {
    return work([&](Evaluation& evaluation) {
      for_each_term(parts_.terms, [&]<class T>(T& term) {
        if constexpr (is_of<T>(account)) term.add(evaluation);
      });
    });
  }

  /// As of the scheme's account, with other cables.
  StepWork work_with(CableTerm& cables) {
    return work([&](Evaluation& evaluation) {
      cables.add(evaluation);
      for_each_term(parts_.terms, [&]<class T>(T& term) {
        if constexpr (is_of<T>(Account::scheme) && !std::is_same_v<T, CableTerm>) term.add(evaluation);
      });
    });
  }

private:
  /// Bodies collect what the others leave on them, and add nothing that the accounts look at.
  template <class T>
  static constexpr bool is_of(Account account) {
    return T::account == account && !std::is_same_v<T, BodyTerm>;
  }

  const partition::LocalNetwork& network_;
  const ForceRule& rule_;
  Parts& parts_;
  const Situation situation_;
  bool has_exchanged_ = false;
};

template <class Terms>
Energies stored_energies(const Terms& terms, const LocalState& state) {
  Energies sum;
  for_each_term(terms, [&](const auto& term) { term.add_energy(state, sum); });
  return sum;
}

}   // namespace

void Assembler::keep_accounts() {
  if (parts_->accounts) return;
  parts_->accounts = std::make_unique<EnergyAccounts>(network_, communicator_, make_vector(), make_vector());
}

void Assembler::keep_looks() { parts_->looks = std::make_unique<EnergyLooks>(communicator_); }

void Assembler::look_at_energy() {
  if (parts_->looks) parts_->looks->add(energies());
}

const EnergySummary* Assembler::energy_summary() const {
  if (parts_->looks) return &parts_->looks->summary();
  return parts_->accounts ? &parts_->accounts->summary() : nullptr;
}

void Assembler::open_accounts(double t, Vec x, Vec v) {
  EnergyAccounts& accounts = *parts_->accounts;
  if (accounts.is_open()) return;
  const LocalState& start = observe(t, x, v, accounts.resting());
  accounts.open(start, stored_energies(parts_->terms, start), parts_->prescribed.work());
}

void Assembler::close_accounts(const Stage& stage, Vec x, Vec v) {
  EnergyAccounts& accounts = *parts_->accounts;
  const LocalState& end = observe(stage.t + stage.dt, x, v, accounts.resting());
  accounts.measure(end);
  StageForces forces(network_, rule_, *parts_, stage);
  StepRecord step{stage,
                  forces.template work<Account::scheme>(),
                  {},
                  {},
                  {},
                  parts_->prescribed.work(),
                  parts_->prescribed.step_shift()};
  step.undamped = accounts.undamped() != nullptr ? forces.work_with(*accounts.undamped()) : step.stored;
  if (network_.surroundings.fluid) step.water = forces.template work<Account::water>();
  if (network_.surroundings.bed) step.bed = forces.template work<Account::bed>();
  accounts.close(step, end, stored_energies(parts_->terms, end));
}

}   // namespace cablenet::system

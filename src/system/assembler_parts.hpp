#pragma once
#include "cablenet/system/assembler.hpp"
#include "energy_accounts.hpp"
#include "prescribed_nodes.hpp"
#include "tension_record.hpp"
#include "terms.hpp"

/// What an assembler is made of.
namespace cablenet::system {

/// Each term is built from the network alone.
template <class... T>
std::tuple<T...> make_terms(const partition::LocalNetwork& network, std::tuple<T...>*) {
  return {T(network)...};
}

/// Calls visit(term) for all terms in their order.
template <class Tuple, class Visit>
void for_each_term(Tuple& terms, Visit&& visit) {
  std::apply([&](auto&... term) { (visit(term), ...); }, terms);
}

/// A stage's motion, in the solver's vectors.
struct StageVectors {
  Vec x = nullptr, v = nullptr, a = nullptr;
};

struct Assembler::Parts {
  Parts(const partition::LocalNetwork& network, MPI_Comm communicator)
      : outside(network),
        exchange(network, communicator),
        prescribed(network),
        pattern(network),
        terms(make_terms(network, static_cast<Terms*>(nullptr))) {
    const auto couple = [this] { for_each_term(terms, [this](auto& term) { term.couplings(pattern); }); };
    couple();
    pattern.fix(communicator);
    couple();
    for_each_term(terms, [this](const auto& term) { has_rates = has_rates || term.has_rates(); });
  }

  BodyTerm& bodies() { return std::get<BodyTerm>(terms); }

  OutsideNodes outside;
  GhostExchange exchange;
  PrescribedNodes prescribed;
  BlockPattern pattern;
  Terms terms;
  bool has_rates = false;
  StageVectors last_residual;
  std::unique_ptr<EnergyAccounts> accounts;   ///< where they are kept
  std::unique_ptr<EnergyLooks> looks;         ///< where energies are looked at instead
  std::unique_ptr<TensionRecord> tensions;    ///< where they are kept
};

}   // namespace cablenet::system

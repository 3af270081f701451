#pragma once
#include "cablenet/accuracy/fineness.hpp"
#include "cablenet/accuracy/history_table.hpp"
#include "cablenet/output/probes.hpp"

namespace cablenet::app {

/// Keeps the history of a run, to judge its accuracy by.  All member functions are collective.
class HistoryRecord {
public:
  /// Of what the scene's history names, or of all points, bodies and cables where it names none.
  HistoryRecord(const scene::Scene& scene, const network::Network& network, const system::Assembler& assembler);

  /// At the assembler's observed state.
  void look(const system::LocalState& state);
  /// On all ranks alike.
  accuracy::HistoryTable table() const;
  /// How much each cable bends, as accuracy::Mesh::grade takes it.
  std::vector<accuracy::Bending> bends() const;

private:
  const network::Network& network_;
  const system::Assembler& assembler_;
  output::Probes probes_;
  std::vector<std::vector<double>> rows_;   ///< on rank 0
  std::vector<double> turns_;               ///< kappa^2 at each element's end, summed over looks [1/m^2]
};

}   // namespace cablenet::app

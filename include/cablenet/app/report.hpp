#pragma once
#include <mpi.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cablenet/app/economy.hpp"
#include "cablenet/app/energy_report.hpp"
#include "cablenet/app/stiffness.hpp"
#include "cablenet/network/network.hpp"
#include "cablenet/partition/partition.hpp"
#include "cablenet/scene/scene.hpp"
#include "cablenet/solve/dynamics.hpp"

/// run.yaml: what was solved and how.
namespace cablenet::app {

struct Report {
  std::string status;               ///< finished | stopped | failed
  std::string message;              ///< why, if not finished
  std::vector<std::string> notes;   ///< what the run warned of, in the order of the warnings
  double reached = 0;               ///< simulated time [s]
  std::string scheme;
  std::string linear_solver;
  solve::Counts counts;
  struct Statics {
    Vector3 frame;         ///< velocity [m/s]
    double imbalance;      ///< largest unbalanced force over the largest load on a node
    double largest_load;   ///< [N]
    int iterations;
    bool ends_by_rounding;   ///< The imbalance is rounding's share, and more than what passes otherwise.
  };
  /// What was found by a tension.
  struct Pretension {
    std::string name;
    bool is_net;
    double value;     ///< a cable's unstretched length [m]; a net's slack
    double tension;   ///< at the cable's start, or the net's mean [N]
  };
  std::vector<Pretension> pretensions;
  std::optional<Statics> statics;          ///< where there was an equilibrium to find
  std::vector<NamedStiffness> stiffness;   ///< in that equilibrium, where the scene asks for it
  /// What was chosen for the accuracy that the scene asks for, and what came of it.
  struct Accuracy {
    double wanted, estimated;                            ///< of the range of a quantity
    std::string quantity;                                ///< the worst one
    std::vector<std::pair<std::string, int>> elements;   ///< of the cables whose elements were chosen
    std::string stepping;
    std::string note;   ///< why it is not reached; empty: it is
  };
  std::optional<Accuracy> accuracy;
  std::optional<EnergyReport> energy;   ///< where accounts were kept
  Economy economy;                      ///< of a run that finished
  /// A part of the run, with its wall time and its time of computing [s].
  struct Phase {
    std::string name;
    double wall = 0;
    double cpu = 0;
  };
  std::vector<Phase> phases;
};

/// While one lives, nothing is said.
class Silence {
public:
  Silence();
  ~Silence();
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
};

/// Says on rank 0 what is worth a line.
void tell(const std::string& text);
/// Says on rank 0, and keeps, what a user should know.  An empty text is none.
void add_note(Report& report, const std::string& text);

/// Says on rank 0, and keeps, what the scene could do without.
void tell_economy(Report& report, const Economy& economy);

/// 128-bit XXH3 of the scene's text, in hexadecimal.
std::string scene_hash(const scene::Scene& scene);

/// "12 nodes, 11 elements, ..." for the terminal.
std::string describe(const scene::Scene& scene, const network::Network& network);

/// "equilibrium: largest unbalanced force 1e-12 of ..." for the terminal.
std::string describe(const Report::Statics& statics);

/// Rank 0 writes `path`, under another name until it is complete.  Collective.
/// @throws OutputError on every rank alike.
void write_report(const std::filesystem::path& path, const scene::Scene& scene, const network::Network& network,
                  const partition::Partition& partition, const Report& report, MPI_Comm communicator);

}   // namespace cablenet::app

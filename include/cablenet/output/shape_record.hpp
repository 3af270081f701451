#pragma once
#include <mpi.h>

#include <vector>

#include "cablenet/network/network.hpp"
#include "cablenet/system/local_state.hpp"

/// How far cables bend and move and bodies turn, as it is at the instants that are written.  So it costs nothing
/// between them.  Tests: tests/parallel/shape_record_test.cpp, tests/cases/economy.py
namespace cablenet::output {

/// Of a cable over all instants.  Means are root mean squares over time and over its inner nodes that nothing but its
/// own elements pulls at.
struct CableShape {
  long nodes = 0;         ///< inner nodes, without taps
  double sag = 0;         ///< mean of h theta/8: so far the arc through three nodes lies from its chords [m]
  double bending = 0;     ///< mean of what that, as a vector, varies by in time [m]
  double motion = 0;      ///< mean distance of a node from its mean place, as seen from the cable's first end [m]
  double deviation = 0;   ///< the largest distance of a node from the line through the cable's ends [m]
  double strain = 0;      ///< mean over time and elements
  double jump = 0;        ///< mean difference of the strains before and after a node
  double wobble = 0;      ///< mean of what that difference varies by in time
  double highest = 0, lowest = 0;   ///< z of its nodes, taps and ends included [m]
};

struct ShapeSummary {
  std::vector<CableShape> cables;   ///< as the scene's; one of one element has no inner nodes
  std::vector<double> turned;       ///< per body: the largest angle from its attitude as drawn [rad]
  double highest = 0, lowest = 0;   ///< z of any node [m]
  long instants = 0;
};

class ShapeRecord {
public:
  /// @param cables  so many of the network's spans are cables
  /// @param here    this rank's share of the network
  ShapeRecord(const network::Network& network, std::size_t cables, const partition::LocalNetwork& here,
              MPI_Comm communicator);

  /// At the first instants, and at every second one after 64.  Collective.
  void look(const system::LocalState& state);
  /// On all ranks alike.  Collective.
  ShapeSummary summary() const;

private:
  /// An inner node that this rank owns, between two elements of one cable.
  struct Inner {
    LocalNode node;
    int before, after;   ///< local elements
    std::size_t cable;
    Vector3 first;                         ///< its place at the first instant, from the cable's first end [m]
    Vector3 sum = Vector3::Zero();         ///< of its ways from there [m]
    double squares = 0;                    ///< of those ways [m^2]
    Vector3 sags = Vector3::Zero();        ///< of h theta/8, towards the chords [m]
    double squared_sags = 0;               ///< [m^2]
    double jumps = 0, squared_jumps = 0;   ///< of strains
  };
  /// An end of a cable that this rank speaks for.
  struct End {
    LocalNode node;
    std::size_t place;   ///< in ends_, per three coordinates
  };
  struct Chord {
    Vector3 direction;
    double length;   ///< [m]
  };
  /// Sums over instants.
  struct Sums {
    double strain = 0;        ///< mean over time and elements
    double elements = 0;      ///< of this rank
    double deviation = 0;     ///< the largest square [m^2]
    double highest, lowest;   ///< [m]
  };

  void find_inner_nodes(const network::Network& network);
  void find_ends(const network::Network& network);
  Vector3 end(std::size_t place) const { return Vector3(ends_.data() + 3 * place); }
  void look_at_elements(const system::LocalState& state);
  void look_at_node(Inner& inner, const system::LocalState& state);
  void look_at_bodies(const system::LocalState& state);
  std::vector<double> sums() const;

  const partition::LocalNetwork& here_;
  MPI_Comm communicator_;
  std::vector<std::size_t> cable_of_;   ///< per local element; many for that of a net
  std::vector<Inner> inner_;
  std::vector<End> own_ends_;
  std::vector<double> ends_;        ///< where the cables' ends are: first and last end by turns, three doubles each [m]
  std::vector<Vector3> lines_;      ///< per cable: the direction from its first to its last end
  std::vector<Chord> chords_;       ///< of each local element at the instant that is looked at
  std::vector<double> strains_;     ///< of each local element at the instant that is looked at
  std::vector<Sums> sums_;          ///< per cable
  std::vector<Quaternion> drawn_;   ///< attitude, per body of the network
  std::vector<double> turned_;      ///< as ShapeSummary; of this rank's bodies
  double highest_, lowest_;         ///< [m]
  long shown_ = 0, instants_ = 0;   ///< all, and those that were looked at
};

}   // namespace cablenet::output

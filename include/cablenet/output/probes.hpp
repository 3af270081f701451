#pragma once
#include <map>
#include <string>
#include <vector>

#include "cablenet/network/network.hpp"
#include "cablenet/output/history.hpp"
#include "cablenet/scene/scene.hpp"
#include "cablenet/system/assembler.hpp"

/// The rows of history.csv.  Tests: tests/parallel/probes_test.cpp
namespace cablenet::output {

/// What the scene's `history` and `energy` ask for, gathered from all ranks.
/// Point: x y z [m], vx vy vz [m/s], ax ay az [m/s^2]; a held or moved one also fx fy fz, the force that holds it [N].
/// Body: x y z vx vy vz ax ay az of its centre of gravity, then qw qx qy qz, a unit quaternion of continuous sign (body
/// axes to world), and wx wy wz, the angular velocity in body axes [rad/s].
/// Cable: tension_from, tension_to [N]: the size of the force that pulls at the cable's end (half an element's weight
/// and inertia included, so it is second order in the element size), negative in compression; 0 at an end where nothing
/// is attached. Energy: kinetic, strain, gravity (m g z), work (by moved points and constant forces), total = kinetic +
/// strain + gravity - work [J].
class Probes {
public:
  Probes(const scene::Scene& scene, const network::Network& network, const system::Assembler& assembler);

  const std::vector<std::string>& columns() const { return columns_; }
  /// The row at the assembler's observed state; complete on rank 0.  Collective.
  const std::vector<double>& row(const system::LocalState& state);

private:
  /// An element's end on this rank.
  struct ElementEnd {
    int element;   ///< local
    int side;      ///< 0 or 1
  };
  struct PointProbe {
    std::size_t column;
    LocalNode node{};   ///< where this rank speaks for it
    bool prescribed = false;
    std::vector<ElementEnd> ends{};   ///< this rank's elements at it, if prescribed
  };
  struct CableProbe {
    std::size_t column;
    ElementEnd end;
  };

  struct BodyProbe {
    std::size_t column;
    LocalNode node{};     ///< where this rank has the body
    std::size_t body{};   ///< index into LocalNetwork::bodies, likewise
  };

  /// By the scene's numbers: this rank's nodes and own elements (none: not here), and ends where nothing pulls.
  struct Lookup {
    Table<SceneNode, LocalNode> node;
    std::vector<int> element;   ///< -1: not here
    Table<SceneNode, bool> bare_end;
    std::map<LocalNode, std::vector<ElementEnd>> ends;   ///< of prescribed nodes
  };

  void add_point(const scene::Scene& scene, const network::Network& network, int index, const Lookup& where);
  void add_body(const network::Network& network, int index);
  void add_cable(const network::Network& network, int index, const Lookup& where);
  void put(std::size_t column, const Vector3& value);
  void put_motion(std::size_t column, const system::LocalState& state, LocalNode node);

  const system::Assembler& assembler_;
  std::vector<std::string> columns_;
  std::vector<PointProbe> points_;
  std::vector<BodyProbe> bodies_;
  std::vector<CableProbe> cables_;
  bool energy_;
  std::vector<double> row_;
};

}   // namespace cablenet::output

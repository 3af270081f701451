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

/// The probes gather from all ranks what the scene's `history` and `energy` ask for.
/// A point has x y z [m], vx vy vz [m/s] and ax ay az [m/s^2].  A held or moved point also has fx fy fz, the force that
/// holds it [N].
/// A body has x y z vx vy vz ax ay az of its centre of gravity.  Then follow qw qx qy qz, a unit quaternion of
/// continuous sign (body axes to world), and wx wy wz, the angular velocity in body axes [rad/s].
/// A cable has tension_from and tension_to [N].  A tension is the size of the force that pulls at the cable's end, with
/// a minus sign in compression, and 0 at an end where nothing is attached.  The force includes half an element's weight
/// and inertia, so that its error is of second order in the element's length.
/// The energies [J] are kinetic, strain, gravity (m g z), work (of moved points, forces and torques), and
/// total = kinetic + strain + gravity - work.  Then follow the accounts dissipated, damping, water and bed, and
/// balance = total + accounts - total at the start.
class Probes {
public:
  Probes(const scene::Scene& scene, const network::Network& network, const system::Assembler& assembler);

  const std::vector<std::string>& columns() const { return columns_; }
  /// The row at the assembler's observed state.  It is complete on rank 0 alone.  Collective.
  const std::vector<double>& row(const system::LocalState& state);

private:
  /// An element's end on this rank.
  struct ElementEnd {
    int element;   ///< local
    int side;      ///< 0 or 1
  };
  struct PointProbe {
    std::size_t column;
    LocalNode node{};   ///< none unless this rank speaks for the point
    bool prescribed = false;
    std::vector<ElementEnd> ends{};   ///< this rank's elements at a prescribed point
  };
  struct CableProbe {
    std::size_t column;
    ElementEnd end;
  };

  struct BodyProbe {
    std::size_t column;
    LocalNode node{};     ///< none unless this rank owns the body
    std::size_t body{};   ///< index into LocalNetwork::bodies, if this rank owns the body
  };

  /// Finds nodes and elements of this rank by the scene's numbers.
  struct Lookup {
    Table<SceneNode, LocalNode> node;                    ///< none if the node is not on this rank
    std::vector<int> element;                            ///< -1 if the element does not belong to this rank
    Table<SceneNode, bool> bare_end;                     ///< nothing pulls at the node but one element
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

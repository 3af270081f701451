#pragma once
#include <petscmat.h>
#include <petscvec.h>

#include <vector>

#include "cablenet/partition/local_network.hpp"
#include "cablenet/petsc/handle.hpp"
#include "cablenet/system/local_state.hpp"
#include "cablenet/system/rules.hpp"

/// Residual and Jacobian of M a + beta M v + f_int = loads on the distributed network.
/// Tests: tests/parallel/assembler_test.cpp
namespace cablenet::system {

using Vector = petsc::Handle<Vec, VecDestroy>;
using Matrix = petsc::Handle<Mat, MatDestroy>;

/// All member functions are collective unless said otherwise.
class Assembler {
public:
  Assembler(partition::LocalNetwork network, ForceRule rule, MPI_Comm communicator);

  const partition::LocalNetwork& network() const { return network_; }
  const ForceRule& rule() const { return rule_; }
  MPI_Comm communicator() const { return communicator_; }

  Vector make_vector() const;
  /// Preallocated AIJ matrix of the network's 3x3 block pattern.
  Matrix make_matrix();
  /// The drawn positions [m] and velocities [m/s] at the start.
  void fill_initial(Vec x, Vec v) const;

  /// Keeps positions and velocities at the step's start, for the two-ended forces.
  void begin_step(double t, Vec x, Vec v);
  /// r = M (a + beta v) + f_int - loads at the stage.  [N]
  /// @returns false on a rank where two neighbouring nodes coincide (or a value is not finite); r is then of no use.
  bool residual(const Stage& stage, Vec x, Vec v, Vec a, Vec r);
  /// The tangent dr/dx_a + shift_v dr/dv_a + shift_a dr/da_a at the state of the last residual.  [N/m]
  void jacobian(const Stage& stage, double shift_v, double shift_a, Mat jacobian);

  /// The mass matrix [kg] and the force -r at (t, x, v) with no acceleration of the free nodes [N]: M a = force.
  void mass_matrix(Mat mass);
  /// s I on the network's pattern.
  void scaled_identity(double s, Mat matrix);
  void force(double t, Vec x, Vec v, Vec force);

  /// Adds the work that moved points do over the accepted step whose last residual this is.  Not collective.
  void add_work(const Stage& stage);

  /// Brings an instant's positions, velocities and accelerations of all local nodes together for energies and probes.
  const LocalState& observe(double t, Vec x, Vec v, Vec a);
  /// This rank's part: kinetic, strain, gravity energy and external work since the start [J].  @pre observe
  Energies energies() const;

  /// From the drawn start.
  ForceScales force_scales();
  /// Scene number of the element that the last residual found without length on this rank; -1: none.  Not collective.
  int coincident_element() const { return coincident_; }

private:
  void scatter(Vec global, std::vector<double>& local) const;
  void add_to_owners(Vec global);
  void start_prescribed(double t);
  void set_prescribed(const Stage& stage);
  template <class Law>
  bool add_residual(const Law& law);
  template <class Law>
  void add_tangent(const Law& law, double shift_v, double shift_a, Mat matrix);
  template <class Visit>
  void visit_law(const Stage& stage, Visit&& visit) const;
  void add_load_residual();

  /// An element's chord and one-ended force at the step's start.
  struct ElementStart {
    elements::Chord chord;
    Vector3 force;
  };
  /// A prescribed node at the two ends of the step.
  struct NodeStep {
    scene::Kinematics start;
    scene::Kinematics end;
    Vector3 previous_reaction = Vector3::Zero();
  };

  partition::LocalNetwork network_;
  ForceRule rule_;
  MPI_Comm communicator_;
  petsc::Handle<VecScatter, VecScatterDestroy> ghosts_;
  Vector local_view_;   ///< a sequential vector on the free part of a local array
  LocalState state_;
  std::vector<double> r_;         ///< per local node
  std::vector<double> tangent_;   ///< 36 per element, then 3 per load
  std::vector<ElementStart> start_;
  std::vector<NodeStep> prescribed_;
  double prescribed_dt_ = -1;   ///< the step that prescribed_'s ends were evaluated for
  double previous_stage_t_ = 0;
  double work_ = 0;
  int coincident_ = -1;
};

}   // namespace cablenet::system

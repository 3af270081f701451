#pragma once
#include <petscvec.h>

#include <memory>
#include <optional>
#include <vector>

#include "cablenet/partition/local_network.hpp"
#include "cablenet/petsc/handle.hpp"
#include "cablenet/petsc/object_state.hpp"
#include "cablenet/system/ghosts.hpp"
#include "cablenet/system/local_state.hpp"
#include "cablenet/system/rules.hpp"
#include "cablenet/system/tangent_matrix.hpp"

/// Residual and tangent of M a + beta M v + f_int = loads on the distributed network, its bodies included.
/// Tests: tests/parallel/assembler_test.cpp, bodies_test.cpp
namespace cablenet::system {

using Vector = petsc::Handle<Vec, VecDestroy>;

class BodySet;

/// All member functions are collective unless said otherwise.
class Assembler {
public:
  Assembler(partition::LocalNetwork network, ForceRule rule, MPI_Comm communicator);
  ~Assembler();

  const partition::LocalNetwork& network() const { return network_; }
  const ForceRule& rule() const { return rule_; }
  MPI_Comm communicator() const { return communicator_; }

  Vector make_vector() const;
  TangentMatrix make_tangent() const;
  /// The drawn positions [m] and velocities [m/s] at the start.
  void fill_initial(Vec x, Vec v) const;

  /// Keeps what the two-ended forces need of the step's start.
  void begin_step(double t, Vec x, Vec v);
  /// r = M (a + beta v) + f_int - loads at the stage.  [N]
  /// With a request, also the tangent dr/dx_a + shift_v dr/dv_a + shift_a dr/da_a [N/m], unpublished.
  /// @returns false on a rank where two neighbouring nodes coincide (or a value is not finite); r is then of no use.
  bool residual(const Stage& stage, Vec x, Vec v, Vec a, Vec r, const TangentRequest* request = nullptr);
  /// The tangent alone, unpublished; cheaper where the last residual was at this x.  @pre no two neighbours coincide
  void tangent(const Stage& stage, Vec x, Vec v, Vec a, const TangentRequest& request);

  /// The mass matrix [kg], unpublished, and the force -r with no acceleration of the free nodes [N], both at (t, x, v):
  /// M a = force.
  void mass_matrix(double t, Vec x, Vec v, TangentMatrix& mass);
  void force(double t, Vec x, Vec v, Vec force);

  /// Ends the accepted step whose last residual this is: adds the work of moved points and torques over it, and sets
  /// the bodies' end velocities where it is a conserving one.  Not collective.
  void end_step(const Stage& stage, Vec x, Vec v);

  /// Brings an instant's positions, velocities and accelerations of all local nodes together for energies and probes.
  const LocalState& observe(double t, Vec x, Vec v, Vec a);
  /// This rank's part: kinetic, strain, gravity energy and external work since the start [J].  @pre observe
  Energies energies() const;
  /// What water and bed push an element's end with.  [N]  @pre observe.  Not collective.
  Vector3 surroundings_force(const partition::LocalElement& element, std::size_t end) const;

  /// In Network::bodies: one on any rank whose Euler angles are singular within a degree of pitch; -1: none.
  int nearly_singular_body(Vec x) const;

  /// From the drawn start.
  ForceScales force_scales();
  /// Scene number of the element that the last residual found without length on this rank; -1: none.  Not collective.
  int coincident_element() const { return coincident_; }
  /// Likewise in Network::bodies of one at pitch 90 degrees, or that turned by half a turn within a step.
  int outside_body() const;

private:
  friend class StaticForces;
  struct Starts;
  struct Access;
  struct NodeStep;
  struct SurroundingsSweep;
  bool conserves(const Stage& stage) const;
  void start_prescribed(double t);
  void add_work(const Stage& stage);
  void set_prescribed(const Stage& stage);
  template <class Visit>
  void visit_law(const Stage& stage, Visit&& visit) const;
  template <class Law>
  void record_starts(const Law& law, const Access& access);
  template <class Law>
  bool run(const Law& law, const Stage& stage, Access& access, const TangentRequest* request);
  template <class Law, bool with_residual, bool with_tangent>
  bool sweep(const Law& law, const Stage& stage, Access& access, const TangentRequest* request);
  template <class Law, bool with_tangent>
  bool sweep_bodies(const Law& law, const Stage& stage, Access& access, const TangentRequest* request);
  void add_loads(double t, Access& access, const TangentRequest* request);
  void add_surroundings(const Stage& stage, Access& access, const TangentRequest* request);
  void add_wet_points(double t, Access& access, const TangentRequest* request);
  const environment::Fluid& water() const { return calm_ ? *calm_ : *network_.surroundings.fluid; }

  partition::LocalNetwork network_;
  ForceRule rule_;
  MPI_Comm communicator_;
  bool is_elastic_;   ///< no material has damping or goes slack
  GhostExchange ghosts_;
  LocalState state_;                  ///< that was observed
  std::vector<NodeMotion> outside_;   ///< of ghosts, prescribed and carried nodes at the stage
  std::vector<bodies::RotationState> ghost_rotations_;
  std::vector<double> outside_r_;    ///< their forces
  std::unique_ptr<Starts> starts_;   ///< per element
  std::unique_ptr<BodySet> bodies_;
  std::vector<NodeStep> prescribed_;
  std::optional<environment::Fluid> calm_;   ///< without waves, while statics is at work
  double bed_softness_ = 1;                  ///< on the way to equilibrium; 0: no bed
  petsc::VectorState evaluated_;             ///< of the x that outside_ belongs to
  Stage evaluated_stage_{};
  double prescribed_dt_ = -1;   ///< the step that prescribed_'s ends were evaluated for
  double previous_stage_t_ = 0, work_ = 0;
  int coincident_ = -1;
};

}   // namespace cablenet::system

#pragma once
#include <petscvec.h>

#include <memory>
#include <span>

#include "cablenet/base/archive.hpp"
#include "cablenet/partition/local_network.hpp"
#include "cablenet/petsc/handle.hpp"
#include "cablenet/petsc/object_state.hpp"
#include "cablenet/system/force_rule.hpp"
#include "cablenet/system/force_scales.hpp"
#include "cablenet/system/local_state.hpp"
#include "cablenet/system/situation.hpp"
#include "cablenet/system/tangent_matrix.hpp"
#include "cablenet/system/tensions.hpp"

/// Residual and tangent of M a + beta M v + f_int = loads on the distributed network, its bodies included, as the sum
/// of the terms in src/system/terms.hpp.  Tests: tests/parallel/assembler_test.cpp, bodies_test.cpp
namespace cablenet::system {

using Vector = petsc::Handle<Vec, VecDestroy>;

/// All member functions are collective unless they say otherwise.
class Assembler {
public:
  /// @throws InputError where a rank's matrix would have more values than 32 bits can count
  Assembler(partition::LocalNetwork network, ForceRule rule, MPI_Comm communicator);
  ~Assembler();

  const partition::LocalNetwork& network() const { return network_; }
  const ForceRule& rule() const { return rule_; }
  MPI_Comm communicator() const { return communicator_; }

  Vector make_vector() const;
  TangentMatrix make_tangent() const;
  /// The positions [m] and velocities [m/s] at the network's start.
  void fill_initial(Vec x, Vec v) const;
  /// Makes x, all of it moving at `velocity` [m/s] and without turning, the network's start.
  void start_from(double t, Vec x, const Vector3& velocity);
  /// Springs of friction hold the local nodes to these places on the bed.  Not collective.
  void grip_bed(const GripPlaces& places);
  /// Multiplies the unstretched lengths of the network's elements [first, first + count).  Not collective.
  void lengthen(int first, int count, double factor);

  /// Keeps what the forces need of a step's start.
  void begin_step(double t, Vec x, Vec v);
  /// r = M (a + beta v) + f_int - loads at the stage.  [N]
  /// With a request, also the tangent dr/dx shift.x + dr/dv shift.v + dr/da shift.a [N/m], unpublished.
  /// @returns false on a rank where two neighbours coincide (or a value is not finite); r is then of no use.
  bool residual(const Stage& stage, Vec x, Vec v, Vec a, Vec r, const TangentRequest* request = nullptr);
  /// The tangent alone, unpublished.  It is cheaper where the last residual was at this x.
  /// @pre no two neighbours coincide
  void tangent(const Stage& stage, Vec x, Vec v, Vec a, const TangentRequest& request);
  /// Ends the accepted step whose last residual this is, and sets the bodies' end velocities where the step conserves.
  /// Collective where accounts are kept; the vectors of the last residual must then still stand.
  void end_step(const Stage& stage, Vec x, Vec v);

  /// As begin_step() and residual(), in any situation.  r may be null where there is a request.
  void begin(const Situation& situation, Vec x, Vec v);
  bool evaluate(const Situation& situation, Vec x, Vec v, Vec a, Vec r, const TangentRequest* request);

  /// The mass matrix [kg], unpublished, and the force -r without the free nodes' acceleration [N]: M a = force.
  void mass_matrix(double t, Vec x, Vec v, TangentMatrix& mass);
  void force(double t, Vec x, Vec v, Vec force);

  /// Brings an instant's positions, velocities and accelerations of all local nodes together for energies and probes.
  /// @param is_calm  the forces on what is observed are those in water without waves, as in statics
  const LocalState& observe(double t, Vec x, Vec v, Vec a, bool is_calm = false);
  /// This rank's part of the observed state's energies, and of what was taken since the start.  @pre observe
  Energies energies() const;
  /// This rank's part of the potential of the internal forces and of the bed in statics.  [J]  @pre observe
  double potential(const Situation& situation) const;
  void keep_accounts();   ///< from the next step on (energy_accounts.hpp); not collective
  /// look_at_energy() looks at the observed state from now on, and did nothing before.  @pre only_formulas_take_energy
  void keep_looks();
  void look_at_energy();
  /// Up to the last step's end or look; nullptr where neither accounts nor looks are kept.  Not collective.
  const EnergySummary* energy_summary() const;
  /// From the next step on, the extremes of tension are kept.  Not collective.
  void keep_tensions();
  /// Of the elements that this rank speaks for, in their order, up to the observed state.  Not collective.
  /// @pre observe, keep_tensions
  std::span<const ElementTension> tensions();
  /// What must pull at an element's end for the observed motion, water and bed included.  [N]  Not collective.
  /// @param element  an index into LocalNetwork::elements   @param end  0 or 1
  Vector3 end_force(int element, std::size_t end) const;
  /// What must act on a node beside its elements for the observed motion.  [N]  Not collective.
  Vector3 node_force(LocalNode node) const;

  /// Of the forces at an instant.  It observes the instant.
  ForceScales force_scales(double t, Vec x, Vec v);
  /// An index into Network::bodies of one, on any rank, within a degree of pitch from singular Euler angles; -1: none.
  int nearly_singular_body(Vec x) const;
  /// Scene number of the element that the last residual found without length on this rank; -1: none.  Not collective.
  int coincident_element() const { return coincident_; }
  /// Likewise in Network::bodies of one at pitch 90 degrees, or that turned by half a turn within a step.
  int outside_body() const;

  /// Saves or loads what the terms keep from step to step, beside x and v.  Not collective.
  void archive(Archive& archive);

private:
  struct Parts;
  bool evaluate_terms(const Situation& situation, Vec x, Vec v, Vec a, Vec r, const TangentRequest* request,
                      bool must_exchange);
  void open_accounts(double t, Vec x, Vec v);
  void close_accounts(const Stage& stage, Vec x, Vec v);

  partition::LocalNetwork network_;
  ForceRule rule_;
  MPI_Comm communicator_;
  std::unique_ptr<Parts> parts_;
  LocalState state_;               ///< that was observed
  petsc::VectorState evaluated_;   ///< of the x of the last step's evaluation
  Stage evaluated_stage_{};
  int coincident_ = -1;
};

}   // namespace cablenet::system

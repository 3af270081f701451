#pragma once
#include <span>
#include <vector>

#include "cablenet/base/archive.hpp"
#include "cablenet/elements/energy_momentum_law.hpp"
#include "cablenet/system/tensions.hpp"
#include "evaluation.hpp"

namespace cablenet::system {

/// Keeps the extremes of tension in the elements that this rank speaks for.  It looks at the starts of steps, where the
/// ghosts' motion is at hand, so it needs one more look at a run's end.  Tests: tests/cases/notes.py,
/// tests/parallel/resume_test.cpp
class TensionRecord {
public:
  explicit TensionRecord(const partition::LocalNetwork& network);

  /// @param start    an evaluation at a step's start
  /// @param reached  the elements' lengths there, or nothing where the law in use does not keep them
  void add(const Evaluation& start, std::span<const elements::ReachedStart> reached);
  /// Up to this state.
  std::span<const ElementTension> until(const LocalState& end);
  void archive(Archive& archive);

private:
  struct Spring {
    double stiffness;   ///< EA/L [N/m]
    double length;      ///< L [m]
  };

  const elements::CableMaterial& material(std::size_t i) const {
    return network_.materials[at(network_.elements[i].material)];
  }
  /// From the instant before [s].
  double since(double t) const { return has_begun_ ? t - last_time_ : 0; }
  /// @param T   in the element i [N]; that of a slack tension_only element may be negative
  /// @param dt  since the instant before [s]
  void take(std::size_t i, double T, double t, double dt);
  template <class Nodes>
  void take_at(double t, partition::Range range, const Nodes& nodes);

  const partition::LocalNetwork& network_;
  bool is_damped_;   ///< Tension depends on velocities, too.
  bool has_begun_ = false;
  double last_time_ = 0;          ///< [s]
  std::vector<Spring> springs_;   ///< of the elements; a step then looks at nothing else of them
  std::vector<ElementTension> elements_;
};

}   // namespace cablenet::system

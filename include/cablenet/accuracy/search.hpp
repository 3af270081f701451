#pragma once
#include <functional>
#include <string>
#include <vector>

#include "cablenet/accuracy/fineness.hpp"
#include "cablenet/accuracy/ladder.hpp"

/// How fine a run has to be for an accuracy.
///
/// Coarse runs are made first.  Each cable has few elements, and the step is halved until its error is four times the
/// wanted one.  Adaptive steps are tried beside them.  With such steps the elements are doubled until their error is
/// three times the wanted one.  Both errors go with the square of the size, so that the cheapest sizes for the accuracy
/// follow.  The run with these is held against the finest one before, and its first tenth against one with half the
/// sizes, as there vibrations last that a start excites.  It is made again, finer, where that shows too large an error.
///
/// An error is the root mean square over time, by the range of the quantity (history_table.hpp).
/// Tests: tests/parallel/accuracy_test.cpp, tests/cases/accuracy.py
namespace cablenet::accuracy {

/// Makes a run.
using Try = std::function<Trial(const Mesh&, const Fineness&)>;
/// The bends of the run that was made last, as Mesh::grade takes them.
using Bends = std::function<std::vector<Bending>()>;

class Search {
public:
  /// @pre the scene asks for an accuracy, and leaves something to be chosen
  Search(const scene::Scene& scene, Try run, Bends bends);

  /// Makes coarse runs, and chooses sizes by them.
  void choose();
  const Mesh& mesh() const { return mesh_; }
  const Fineness& chosen() const { return chosen_; }
  bool chooses_steps() const { return !scene_.is_static && scene_.time.step == 0; }
  /// Half the chosen sizes.
  Fineness finer() const;
  /// The error of a run with the chosen sizes.  Sizes that the scene gives are taken as exact.
  /// @param check  the first part of a run with half the sizes, where there is one
  Estimate estimate(const Trial& run, const Trial& check = {});
  /// An estimate is itself good to a factor of 1.5.
  bool is_reached() const { return found_.error <= 1.5 * wanted_; }
  /// Whether a finer run may help where the accuracy is not reached.
  bool can_refine() const;
  /// Chooses finer sizes.
  /// @param run  with the sizes that were chosen, as estimated
  void refine(Trial run);

private:
  /// Per column of the history.
  using Errors = std::vector<double>;
  /// One of the two sizes of a run that others are held against, and what it errs by in that.
  struct Reference {
    double size = 0;   ///< 0: it is not chosen
    Errors errors = {};
    double scale = 1;   ///< the chosen size over this one

    double before(std::size_t column) const { return column < errors.size() ? errors[column] : 0; }
    double now(std::size_t column) const { return scale * scale * before(column); }
    void follow(const Errors& shares);
  };

  bool may_run() const;
  Trial run(const Fineness& sizes);
  double rounded(double step) const;
  Stepping stepping(double size) const;
  bool begin();
  void climb_steps(double first);
  void try_adaptive();
  Ladder adaptive_run(const HistoryTable& truth, double equal);
  void climb_meshes();
  void settle();
  void choose_scales();
  void halve();
  void take_scales();
  double together(double mesh_scale, double step_scale) const;

  const scene::Scene& scene_;
  double interval_;   ///< of rows [s]
  double wanted_;
  Try try_;
  Bends bends_;
  Mesh mesh_;
  int runs_ = 0, refined_ = 0;
  double first_elements_;
  bool is_adaptive_ = false;
  double adaptive_start_ = 0;   ///< the first adaptive step [s]
  Ladder steps_;                ///< sizes: the step [s], or the cube root of the tolerance
  Ladder meshes_;               ///< sizes: one over elements
  Errors adaptive_errors_;      ///< of the adaptive run
  Trial reference_;             ///< the finest run before the one with the chosen sizes
  Reference by_mesh_, by_step_;
  bool goes_down_ = false;   ///< The reference is fine enough for errors to go with the square of sizes.
  bool can_reach_ = false;   ///< Some sizes should do, by the reference's errors.
  Fineness chosen_;
  Errors run_errors_;   ///< of the run with the chosen sizes
  Estimate found_;
  double before_ = 0;   ///< the error of the run before the last one
};

}   // namespace cablenet::accuracy

#include "cablenet/accuracy/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cablenet::accuracy {
namespace {

/// Coarse runs end where their error is this many times the wanted one: of steps, and of meshes.
constexpr double coarse_steps = 4, coarse_meshes = 3;
/// A mesh is not judged by fewer runs.
constexpr std::size_t least_meshes = 3;
/// Sizes are chosen for this share of the wanted error.
constexpr double aimed = 0.75;
/// A size is not chosen coarser than this times that of the finest coarse run: the one before it was as coarse.
constexpr double most_coarser = 2;
/// Nor finer at once than one over this.
constexpr double most_finer = 8;
/// Sizes that are looked at go down by this factor.
constexpr double next_size = 0.98;
/// A run whose error should be more than this share of the reference's tells nothing of itself by their difference.
constexpr double least_gain = 0.7;
/// Steps are halved until so many runs in a row have brought too little.
constexpr int most_stuck = 2;
/// A difference beyond this times what the reference should err by is what coarse runs do not show, such as axial
/// vibration.  Nobody knows how it goes down, so it counts whole.
constexpr double most_foreseen = 1.5;
/// So many coarse runs are made at most, and so many elements a cable has in them.
constexpr int most_runs = 24;
constexpr double most_elements = 128;
/// The search gives up after so many runs that fail, or after so many that find no equilibrium to start from.
constexpr int most_failed = 8, most_without_start = 3;
/// A run is made again so many times, with so many times the work at most, and not again where that left more than this
/// share of the error.
constexpr int most_refined = 2;
constexpr double most_more_work = 5, least_help = 0.7;
/// The tolerance of the first adaptive run, over the extent of the scene, for an error of 1.  The local error goes with
/// the step to the power 3, and the error with its square.
constexpr double first_tolerance = 3;
constexpr int most_adaptive = 3;
/// Adaptive steps are taken where they need less than this share of the work, and given up where they need so many
/// times the work.
constexpr double worth_it = 0.9, hopeless = 4;

constexpr double endless = std::numeric_limits<double>::infinity();

double largest(const std::vector<double>& errors) {
  return errors.empty() ? 0 : *std::max_element(errors.begin(), errors.end());
}

}   // namespace

/// The run with the chosen size takes the place of the reference.
void Search::Reference::follow(const Errors& shares) {
  size *= scale;
  errors = shares;
  scale = 1;
}

Search::Search(const scene::Scene& scene, Try run, Bends bends)
    : scene_(scene),
      interval_(interval_of_rows(scene)),
      wanted_(*scene.accuracy),
      try_(std::move(run)),
      bends_(std::move(bends)),
      mesh_(scene),
      first_elements_(first_elements) {}

bool Search::may_run() const { return runs_ < most_runs; }

Trial Search::run(const Fineness& sizes) {
  ++runs_;
  return try_(mesh_, sizes);
}

/// The longest step that is not longer, and divides the interval of rows.
double Search::rounded(double step) const {
  return interval_ / std::max(1.0, std::ceil(interval_ / step * (1 - 1e-9)));
}

Stepping Search::stepping(double size) const {
  if (!chooses_steps()) return {};
  if (is_adaptive_) return {adaptive_start_, size * size * size};
  return {rounded(size), {}};
}

void Search::choose() {
  if (!begin()) return;
  if (chooses_steps() && !scene_.time.tolerance) try_adaptive();
  if (!mesh_.is_given()) climb_meshes();
  settle();
}

/// The first run that comes to its end says how a mesh is graded.  Shorter steps help where a run does not, and more
/// elements where there is no equilibrium.
bool Search::begin() {
  double step = chooses_steps() ? interval_ : 0;
  for (int failed = 0, without_start = 0; failed < most_failed && without_start < most_without_start; ++failed) {
    chosen_ = {first_elements_, stepping(step)};
    const Trial first = run(chosen_);
    if (first.is_done) {
      if (!mesh_.is_given()) mesh_.grade(bends_());
      if (chooses_steps()) climb_steps(step);
      return true;
    }
    without_start += first.has_start ? 0 : 1;
    if (chooses_steps() && first.has_start)
      step /= 2;
    else if (!mesh_.is_given())
      first_elements_ *= 2;
    else
      return false;
  }
  return false;
}

void Search::climb_steps(double first) {
  int stuck = 0;
  for (double step = rounded(first); may_run(); step = rounded(step / 2)) {
    Trial trial = run({first_elements_, stepping(step)});
    if (trial.is_done)
      steps_.add(step, std::move(trial));
    else
      steps_.clear();
    stuck = steps_.is_stuck() ? stuck + 1 : 0;
    if (steps_.error() <= coarse_steps * wanted_ || stuck == most_stuck) return;
  }
}

/// Takes adaptive steps where they should need less work for the accuracy.
void Search::try_adaptive() {
  if (steps_.count() < 2) return;
  const HistoryTable truth = steps_.limit();
  const double equal = steps_.finest_trial().work * std::sqrt(steps_.error());
  adaptive_start_ = steps_.finest() / 4;
  is_adaptive_ = true;
  Ladder adaptive = adaptive_run(truth, equal);
  is_adaptive_ = false;
  if (adaptive.count() == 0) return;
  adaptive_errors_ = differences(adaptive.finest_trial().history, truth);
  is_adaptive_ = adaptive.finest_trial().work * std::sqrt(largest(adaptive_errors_)) < worth_it * equal;
  if (is_adaptive_) steps_ = std::move(adaptive);
}

/// One adaptive run, whose error is about that of the coarse steps.
Ladder Search::adaptive_run(const HistoryTable& truth, double equal) {
  Ladder found;
  double size = std::cbrt(first_tolerance * std::pow(coarse_steps * wanted_, 1.5) * mesh_.extent());
  for (int attempt = 0; attempt < most_adaptive && may_run(); ++attempt) {
    Trial trial = run({first_elements_, stepping(size)});
    if (!trial.is_done) return {};
    const double error = largest(differences(trial.history, truth));
    if (trial.work * std::sqrt(error) > hopeless * equal) return {};
    found.clear();
    found.add(size, std::move(trial));
    if (error < coarse_steps * wanted_) return found;
    size *= std::max(0.1, std::sqrt(coarse_steps * wanted_ / (2 * error)));
  }
  return found;
}

void Search::climb_meshes() {
  const double size = steps_.count() > 0 ? steps_.finest() : 0;
  for (double elements = first_elements_ / 2; may_run() && elements <= most_elements; elements *= 2) {
    const double had = mesh_.had(elements);
    if (meshes_.count() > 0 && had <= 1 / meshes_.finest()) continue;
    const bool is_known = elements == first_elements_ && steps_.count() > 0;
    Trial trial = is_known ? steps_.finest_trial() : run({elements, stepping(size)});
    if (trial.is_done)
      meshes_.add(1 / had, std::move(trial));
    else
      meshes_.clear();
    const bool is_fine = meshes_.count() >= least_meshes && meshes_.error() <= coarse_meshes * wanted_;
    if (is_fine || meshes_.is_stuck()) return;
  }
}

/// The finest run of the meshes, or of the steps where meshes are given, is what others are held against.
void Search::settle() {
  if (steps_.count() > 0) {
    by_step_ = {steps_.finest(), is_adaptive_ ? adaptive_errors_ : steps_.errors()};
    reference_ = steps_.finest_trial();
  }
  if (meshes_.count() > 0) {
    by_mesh_ = {meshes_.finest(), meshes_.errors()};
    reference_ = meshes_.finest_trial();
  }
  goes_down_ =
      largest(by_step_.errors) <= coarse_steps * wanted_ && largest(by_mesh_.errors) <= coarse_meshes * wanted_;
  choose_scales();
}

/// The largest error of a run whose sizes are scaled so.
double Search::together(double mesh_scale, double step_scale) const {
  double most = 0;
  for (std::size_t c = 0; c < std::max(by_mesh_.errors.size(), by_step_.errors.size()); ++c)
    most = std::max(most, mesh_scale * mesh_scale * by_mesh_.before(c) + step_scale * step_scale * by_step_.before(c));
  return most;
}

/// The cheapest sizes whose errors together are small enough.  The cost goes with one over both sizes.  Where none are,
/// both are halved.
void Search::choose_scales() {
  const bool has_mesh = by_mesh_.size > 0, has_step = by_step_.size > 0;
  double least = endless;
  for (double mesh = has_mesh ? most_coarser : 1; mesh > 1 / most_finer; mesh *= next_size) {
    double step = has_step ? most_coarser : 1;
    while (has_step && step > 1 / most_finer && together(mesh, step) > aimed * wanted_) step *= next_size;
    if (together(mesh, step) <= aimed * wanted_ && 1 / (mesh * step) < least) {
      least = 1 / (mesh * step);
      by_mesh_.scale = mesh;
      by_step_.scale = step;
    }
    if (!has_mesh) break;
  }
  can_reach_ = least < endless;
  if (!can_reach_) return halve();
  take_scales();
}

void Search::halve() {
  by_mesh_.scale = by_mesh_.size > 0 ? 0.5 : 1;
  by_step_.scale = by_step_.size > 0 ? 0.5 : 1;
  take_scales();
}

void Search::take_scales() {
  chosen_ = {by_mesh_.size > 0 ? 1 / (by_mesh_.size * by_mesh_.scale) : first_elements_,
             stepping(by_step_.size * by_step_.scale)};
}

Fineness Search::finer() const {
  return {by_mesh_.size > 0 ? 2 * chosen_.elements : chosen_.elements, stepping(by_step_.size * by_step_.scale / 2)};
}

Estimate Search::estimate(const Trial& run, const Trial& check) {
  found_ = {endless, ""};
  if (!reference_.is_done) return found_;
  run_errors_ = differences(reference_.history, run.history);
  for (std::size_t c = 0; c < run_errors_.size(); ++c) {
    const double before = by_mesh_.before(c) + by_step_.before(c), now = by_mesh_.now(c) + by_step_.now(c);
    double& error = run_errors_[c];
    const bool is_told = goes_down_ && before > 0 && now < least_gain * before;
    const double unforeseen = error - most_foreseen * before;
    error = is_told ? std::max({error * now / (before - now), now / 2, unforeseen}) : std::max(error, now);
  }
  if (check.is_done) {
    const Errors at_first = errors_at_first(run.history, check.history);
    for (std::size_t c = 0; c < at_first.size(); ++c) run_errors_[c] = std::max(run_errors_[c], at_first[c]);
  }
  return found_ = accuracy::largest(run_errors_, run.history);
}

bool Search::can_refine() const {
  const bool helps = refined_ == 0 || found_.error < least_help * before_;
  return !is_reached() && reference_.is_done && can_reach_ && helps && refined_ < most_refined;
}

void Search::refine(Trial run) {
  ++refined_;
  before_ = found_.error;
  Errors mesh(run_errors_.size()), step(run_errors_.size());
  for (std::size_t c = 0; c < run_errors_.size(); ++c) {
    const double of_mesh = by_mesh_.now(c), of_step = by_step_.now(c), sum = of_mesh + of_step;
    mesh[c] = sum > 0 ? run_errors_[c] * of_mesh / sum : run_errors_[c];
    step[c] = sum > 0 ? run_errors_[c] * of_step / sum : run_errors_[c];
  }
  if (by_mesh_.size > 0) by_mesh_.follow(mesh);
  if (by_step_.size > 0) by_step_.follow(step);
  reference_ = std::move(run);
  goes_down_ = true;
  choose_scales();
  if (by_mesh_.scale * by_step_.scale < 1 / most_more_work) halve();
}

}   // namespace cablenet::accuracy

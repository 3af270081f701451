#include "accurate_run.hpp"

#include <fmt/format.h>
#include <petscsys.h>

#include <cmath>
#include <limits>

#include "cablenet/accuracy/search.hpp"
#include "cablenet/app/simulation.hpp"
#include "cablenet/base/errors.hpp"
#include "cablenet/petsc/options.hpp"
#include "trial.hpp"

namespace cablenet::app {
namespace {

/// The part of the run's time that is compared with a run of half the sizes.
constexpr double checked_part = 0.1;

std::string percent(double share) { return fmt::format("{:.2g} %", 100 * share); }

std::string describe(const accuracy::Stepping& stepping) {
  if (stepping.tolerance) return fmt::format("adaptive steps with a tolerance of {:.3g} m", *stepping.tolerance);
  return fmt::format("steps of {:.6g} s", stepping.step);
}

/// These options would give all runs the same steps, so that they could not be compared.
void refuse_step_options(const scene::Scene& scene) {
  if (scene.is_static) return;
  for (const char* name : {"-ts_dt", "-ts_adapt_type", "-ts_max_steps"})
    if (petsc::has_option(name, nullptr))
      throw InputError(fmt::format(
          "{}: is not allowed with `accuracy`, which compares runs of other steps; give time.step instead", name));
}

std::string words(const accuracy::Estimate& found) {
  if (!std::isfinite(found.error)) return "nothing is known of the error, as no quantity of the history shows any";
  return fmt::format("estimated {} of the range of {}", percent(found.error), found.quantity);
}

class AccurateRun {
public:
  AccurateRun(const scene::Scene& scene, const std::string& directory)
      : scene_(scene),
        directory_(directory),
        interval_(accuracy::interval_of_rows(scene)),
        search_(
            scene, [this](const accuracy::Mesh& mesh, const accuracy::Fineness& sizes) { return look(mesh, sizes); },
            [this] { return bends_; }) {}

  int run() {
    tell(fmt::format("{}: accuracy {}: coarse runs tell what it needs", scene_.file, percent(*scene_.accuracy)));
    search_.choose();
    for (;;) {
      const scene::Scene made = accuracy::made(scene_, search_.mesh(), search_.chosen());
      const int status =
          simulate(made, directory_, {interval_, [&](accuracy::Trial run) { return judge(made, std::move(run)); }});
      if (status != 0 || !last_.is_done || !search_.can_refine()) return status;
      search_.refine(std::move(last_));
      last_ = {};
      tell("the run errs by more than is wanted: once more, with finer sizes");
    }
  }

private:
  accuracy::Trial look(const accuracy::Mesh& mesh, const accuracy::Fineness& sizes) {
    scene::Scene made = accuracy::made(scene_, mesh, sizes);
    made.output.interval = interval_;
    CoarseRun found = run_coarsely(made);
    bends_ = std::move(found.bends);
    std::string text = mesh.is_given() ? "" : fmt::format("{} elements", elements_of(mesh, sizes));
    if (search_.chooses_steps()) text += (text.empty() ? "" : ", ") + describe(sizes.stepping);
    tell(fmt::format("  looked at {}{}", text, found.trial.is_done ? "" : ": it did not come to its end"));
    return std::move(found.trial);
  }

  /// The first tenth of the run, with half the sizes.
  accuracy::Trial check() const {
    scene::Scene made = accuracy::made(scene_, search_.mesh(), search_.finer());
    made.output.interval = interval_;
    made.time.end = made.time.start + checked_part * (made.time.end - made.time.start);
    return run_coarsely(made).trial;
  }

  static int elements_of(const accuracy::Mesh& mesh, const accuracy::Fineness& sizes) {
    int sum = 0;
    for (const auto& [cable, number] : mesh.counts(sizes.elements)) sum += number;
    return sum;
  }

  Report::Accuracy judge(const scene::Scene& made, accuracy::Trial run) {
    const accuracy::Estimate found = search_.estimate(run, check());
    last_ = std::move(run);
    Report::Accuracy report{*scene_.accuracy, found.error, found.quantity, {}, "", ""};
    for (const auto& [cable, number] : search_.mesh().counts(search_.chosen().elements))
      report.elements.emplace_back(made.cables[cable].name, number);
    if (search_.chooses_steps()) report.stepping = describe(search_.chosen().stepping);
    tell(fmt::format("accuracy: {}{}", words(found), scope()));
    if (!search_.is_reached() && !search_.can_refine())
      report.note = fmt::format(
          "the accuracy of {} is not reached: {}. Finer runs do not bring that down as they should: the motion has "
          "jumps or vibrations that no mesh or step resolves, or is chaotic. `cablenet chart` shows what can be had",
          percent(*scene_.accuracy), words(found));
    return report;
  }

  /// What the estimate is of, where that is not all.
  std::string scope() const {
    std::string text;
    if (search_.mesh().is_given() && !scene_.cables.empty()) text = ", by steps alone, as elements are given";
    if (!scene_.is_static && !search_.chooses_steps()) text = ", by elements alone, as time.step is given";
    if (!scene_.nets.empty()) text += "; what nets err by is not in it";
    return text;
  }

  const scene::Scene& scene_;
  const std::string& directory_;
  double interval_;   ///< of rows [s]
  accuracy::Search search_;
  std::vector<accuracy::Bending> bends_;
  accuracy::Trial last_;
};

/// The run with sizes that are all given, held against one with half the elements and twice the step.
int simulate_held_against_half(const scene::Scene& scene, const std::string& directory) {
  tell(
      fmt::format("{}: accuracy {}: elements and step are given; a run with half the elements and twice the step tells "
                  "what they err by",
                  scene.file, percent(*scene.accuracy)));
  const accuracy::Trial half = run_coarsely(accuracy::halved(scene)).trial;
  const auto judge = [&](const accuracy::Trial& run) {
    accuracy::Estimate found{std::numeric_limits<double>::infinity(), ""};
    if (half.is_done) found = accuracy::largest(accuracy::differences(half.history, run.history), run.history);
    found.error /= 3;
    tell(fmt::format("accuracy: {}", words(found)));
    Report::Accuracy report{*scene.accuracy, found.error, found.quantity, {}, "", ""};
    if (found.error > 1.5 * *scene.accuracy)
      report.note = fmt::format(
          "the accuracy of {} is not reached: {}. Leave out elements and time.step, and they are "
          "chosen for it",
          percent(*scene.accuracy), words(found));
    return report;
  };
  return simulate(scene, directory, {accuracy::interval_of_rows(scene), judge});
}

}   // namespace

int simulate_accurately(const scene::Scene& given, const std::string& directory) {
  scene::Scene scene = given;
  // Nets alone have nothing else that a history could tell.
  if (scene.points.empty() && scene.bodies.empty() && scene.cables.empty()) scene.output.energy = true;
  refuse_step_options(scene);
  if (!accuracy::is_open(scene)) return simulate_held_against_half(scene, directory);
  return AccurateRun(scene, directory).run();
}

scene::Scene first_choice(const scene::Scene& scene) {
  return accuracy::made(scene, accuracy::Mesh(scene),
                        {accuracy::first_elements, {accuracy::interval_of_rows(scene), {}}});
}

}   // namespace cablenet::app

#include "cablenet/app/simulation.hpp"

#include <fmt/format.h>
#include <petscts.h>

#include <optional>

#include "cablenet/accuracy/fineness.hpp"
#include "cablenet/app/progress.hpp"
#include "cablenet/app/run_notes.hpp"
#include "cablenet/base/errors.hpp"
#include "cablenet/network/build.hpp"
#include "cablenet/network/drawn_notes.hpp"
#include "cablenet/output/frames.hpp"
#include "cablenet/output/probes.hpp"
#include "cablenet/output/shape_record.hpp"
#include "cablenet/petsc/solver_types.hpp"
#include "cablenet/solve/energy_watch.hpp"
#include "cablenet/solve/relaxation.hpp"
#include "cablenet/solve/scheme.hpp"
#include "choices.hpp"
#include "equilibrium.hpp"
#include "history_record.hpp"
#include "stopwatch.hpp"
#include "text_file.hpp"

namespace cablenet::app {
namespace {

using petsc::check;

/// The phase with the computing time of the rank that computed most.  Collective.
Report::Phase slowest(Report::Phase phase) {
  MPI_Allreduce(MPI_IN_PLACE, &phase.cpu, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  return phase;
}

class Simulation {
public:
  Simulation(const scene::Scene& scene, std::filesystem::path directory, const Judge& judge)
      : scene_(scene),
        directory_(std::move(directory)),
        judge_(judge),
        time_(chosen_time(scene.time)),
        rule_(chosen_force_rule(time_)),
        network_(network::build_network(scene)),
        partition_(partition::make_partition(network_, PETSC_COMM_WORLD)) {
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank_);
    MPI_Comm_size(PETSC_COMM_WORLD, &ranks_);
    assembler_.emplace(partition::make_local_network(network_, partition_, rank_), rule_, PETSC_COMM_WORLD);
    // Options that are not allowed are refused before anything is written.
    scene_.starts_static ? set_up_statics() : set_up_dynamics();
  }

  int run() {
    for (const std::string& text : network::drawn_notes(scene_, network_)) add_note(report_, text);
    watch_.lap(set_up_);
    const bool has_lengths = !equilibrium_ || equilibrium_->find_lengths(network_, report_);
    watch_.lap(statics_);
    open_output();
    watch_.lap(set_up_);
    if (!has_lengths) return conclude_statics(false);
    if (scene_.starts_static && !find_equilibrium()) return conclude_statics(false);
    if (scene_.is_static) return conclude_statics(true);
    return run_dynamics();
  }

private:
  void introduce(const std::string& way) const {
    if (rank_ == 0 && report_.statics)
      fmt::print("{}\n", way);
    else if (rank_ == 0)
      fmt::print("{}: {}; {} rank{}, {}\n", scene_.file, describe(scene_, network_), ranks_, ranks_ == 1 ? "" : "s",
                 way);
  }

  void set_up_statics() {
    equilibrium_.emplace(scene_, time_, *assembler_);
    introduce(fmt::format("statics, {}", equilibrium_->linear_solver()));
  }

  void set_up_dynamics() {
    solve::Dynamics::Settings settings{judge_.judge ? judge_.interval : scene_.output.interval};
    settings.keeps_accounts = scene_.output.energy;
    settings.takes_notes = true;
    dynamics_.emplace(*assembler_, time_, settings);
    introduce(fmt::format("{}, {}", solve::describe(time_, rule_), dynamics_->linear_solver()));
  }

  void open_output() {
    frames_.emplace(network_, partition_, *assembler_);
    probes_.emplace(scene_, network_, *assembler_);
    if (judge_.judge) record_.emplace(scene_, network_, *assembler_);
    shapes_.emplace(network_, scene_.cables.size(), assembler_->network(), PETSC_COMM_WORLD);
    output::Series::Options options;
    options.scene_hash = scene_hash(scene_);
    options.version = CABLENET_VERSION;
    series_.emplace(PETSC_COMM_WORLD, directory_, frames_->mesh(), options);
    int failed = 0;
    std::string problem;
    if (rank_ == 0) try {
        for (const char* name : {"run.yaml", "stiffness.csv"}) std::filesystem::remove(directory_ / name);
        history_.emplace(directory_ / "history.csv", probes_->columns());
      } catch (const std::exception& error) {
        failed = 1;
        problem = error.what();
      }
    MPI_Bcast(&failed, 1, MPI_INT, 0, PETSC_COMM_WORLD);
    if (failed) throw OutputError(problem);
  }

  bool find_equilibrium() {
    const bool found = equilibrium_->find(network_, report_);
    if (!report_.stiffness.empty())
      write_text_file(directory_ / "stiffness.csv", stiffness_table(report_.stiffness), PETSC_COMM_WORLD);
    watch_.lap(statics_);
    return found;
  }

  /// Writes the equilibrium, or the best shape on the way to it.
  int conclude_statics(bool found) {
    const system::Vector x = assembler_->make_vector(), v = assembler_->make_vector(), a = assembler_->make_vector();
    assembler_->fill_initial(x, v);
    write({time_.start, 0, x, v, a});
    finish_output();
    report_.scheme = "static";
    report_.linear_solver = equilibrium_->linear_solver();
    if (found && !judge_.judge)
      tell_economy(report_, economy_of(scene_, network_, shapes_->summary(), std::nullopt, 0));
    return conclude(found ? solve::Verdict::finished : solve::Verdict::failed, equilibrium_->advice());
  }

  int run_dynamics() {
    if (equilibrium_) {
      equilibrium_.reset();
      set_up_dynamics();
      watch_.lap(set_up_);
    }
    Progress progress(time_.start, time_.end);
    const solve::Verdict verdict = dynamics_->run({
        [&](const solve::Instant& instant) { write(instant); },
        [&](double t, double dt, const solve::Counts& counts) {
          if (rank_ == 0) progress.step(t, dt, counts.steps, counts.newton);
        },
    });
    finish_output();
    report_.counts = dynamics_->counts();
    report_.scheme = solve::describe(time_, rule_);
    report_.linear_solver = dynamics_->linear_solver();
    if (rank_ == 0) progress.finish(report_.reached, report_.counts.steps, report_.counts.newton);
    double lost = 0;
    if (const system::EnergySummary* const energy = assembler_->energy_summary()) {
      const EnergyReport found(*energy, scene_);
      if (scene_.output.energy || dynamics_->is_watched()) report_.energy = found;
      if (rank_ == 0 && report_.energy) fmt::print("{}\n", describe(found));
      const std::string note = note_of_dissipation(found);
      add_note(report_, note);
      if (note.empty()) lost = lost_share(found);
    }
    const std::optional<solve::StepFindings> steps = dynamics_->step_findings();
    const double total_share = steps ? steps->total_share() : 0;
    for (const std::string& text : tension_notes(scene_, network_, *assembler_, total_share)) add_note(report_, text);
    if (steps)
      for (const std::string& text : step_notes(*steps, report_.counts, lost)) add_note(report_, text);
    if (verdict == solve::Verdict::finished && !judge_.judge)
      tell_economy(report_, economy_of(scene_, network_, shapes_->summary(), steps, lost));
    if (dynamics_->has_gained_energy())
      report_.message = fmt::format("at t = {:.9g} s {}", report_.reached, describe_gain(*report_.energy));
    else if (verdict == solve::Verdict::failed)
      report_.message = fmt::format("at t = {:.9g} s the solver could not go on {}", report_.reached, explanation());
    return conclude(verdict, verdict == solve::Verdict::failed ? advice() : "");
  }

  void write(const solve::Instant& instant) {
    watch_.lap(solving_);
    try {
      const system::LocalState& state =
          assembler_->observe(instant.t, instant.x, instant.v, instant.a, scene_.is_static);
      assembler_->look_at_energy();
      if (record_) record_->look(state);
      if (record_ && !accuracy::is_written(scene_, judge_.interval, instant.t)) return;
      shapes_->look(state);
      const std::vector<double>& row = probes_->row(state);
      if (history_) history_->write(row);
      series_->write(frames_->collect(state, instant.step));
    } catch (const OutputError& error) {
      abort_output(error);
    }
    report_.reached = instant.t;
    watch_.lap(writing_);
  }

  void finish_output() {
    watch_.lap(solving_);
    try {
      series_->close();
    } catch (const OutputError& error) {
      abort_output(error);
    }
    watch_.lap(writing_);
  }

  /// One rank alone may be here, so the others are not waited for.
  [[noreturn]] static void abort_output(const OutputError& error) {
    fmt::print(stderr, "cablenet: error: {}\n", error.what());
    MPI_Abort(PETSC_COMM_WORLD, 4);
    std::abort();
  }

  int conclude(solve::Verdict verdict, const std::string& advice) {
    report_.status = "finished";
    if (record_ && verdict != solve::Verdict::failed) {
      report_.accuracy = judge_.judge({true, true, record_->table()});
      add_note(report_, report_.accuracy->note);
    }
    if (verdict == solve::Verdict::stopped) report_.status = "stopped";
    if (verdict == solve::Verdict::failed) report_.status = "failed";
    for (const auto& phase : {set_up_, statics_, solving_, writing_}) report_.phases.push_back(slowest(phase));
    write_report(directory_ / "run.yaml", scene_, network_, partition_, report_, PETSC_COMM_WORLD);
    if (rank_ == 0) fmt::print("results in {}: open {} in ParaView\n", directory_.string(), indexes());
    if (verdict != solve::Verdict::failed) return 0;
    if (rank_ == 0)
      fmt::print(stderr, "cablenet: error: {}. The {} is saved as the last frame in {}. {}\n", report_.message,
                 dynamics_ ? "state at that time" : "last shape", directory_.string(), advice);
    return 3;
  }

  /// What ParaView opens of this run.
  std::string indexes() const {
    if (network_.bodies.empty()) return "cables.xmf";
    return network_.elements.empty() ? "bodies.xmf" : "cables.xmf and bodies.xmf";
  }

  bool is_singular_attitude() const {
    return failed_.left_domain &&
           network_.bodies[static_cast<std::size_t>(failed_.body)].properties.rotation == bodies::Rotation::euler;
  }

  /// Where and why the solver could not go on.
  std::string explanation() {
    failed_ = dynamics_->failed_part();
    if (failed_.body < 0)
      return fmt::format("near cable {}: {}", network_.element_name(failed_.element), dynamics_->failure());
    const std::string& name = network_.bodies[static_cast<std::size_t>(failed_.body)].name;
    if (is_singular_attitude())
      return fmt::format("at body {}: its pitch comes to 90 degrees, where roll and yaw cannot be told apart", name);
    if (failed_.left_domain) return fmt::format("at body {}: it turns by half a turn within a step", name);
    return fmt::format("at body {}: {}", name, dynamics_->failure());
  }

  std::string advice() const {
    if (dynamics_->has_gained_energy()) return solve::cure_of_gain(time_.scheme);
    if (is_singular_attitude()) return "Give the body rotation: quaternion, the default, which has no such attitude";
    if (failed_.left_domain) return "Try a smaller time.step";
    return fmt::format("Try a smaller time.step or {}", solve::row_of(time_.scheme).advice);
  }

  const scene::Scene& scene_;
  std::filesystem::path directory_;
  const Judge& judge_;
  Stopwatch watch_;
  scene::Time time_;
  system::ForceRule rule_;
  network::Network network_;
  partition::Partition partition_;
  int rank_ = 0;
  int ranks_ = 1;
  std::optional<system::Assembler> assembler_;
  std::optional<Equilibrium> equilibrium_;   ///< until the run goes on from it
  std::optional<solve::Dynamics> dynamics_;
  std::optional<output::Frames> frames_;
  std::optional<output::Probes> probes_;
  std::optional<HistoryRecord> record_;   ///< where somebody judges the run
  std::optional<output::ShapeRecord> shapes_;
  std::optional<output::Series> series_;
  std::optional<output::History> history_;   ///< rank 0
  Report report_;
  solve::FailedPart failed_;
  Report::Phase set_up_{"set_up"};
  Report::Phase statics_{"statics"};
  Report::Phase solving_{"solve"};
  Report::Phase writing_{"output"};
};

}   // namespace

int simulate(const scene::Scene& scene, const std::string& directory, const Judge& judge) {
  petsc::check_solver_types(nullptr);
  petsc::check_solver_types(solve::relaxation_prefix);
  return Simulation(scene, directory, judge).run();
}

}   // namespace cablenet::app

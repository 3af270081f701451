#include "trial.hpp"

#include <petscsys.h>

#include <optional>

#include "cablenet/base/errors.hpp"
#include "cablenet/network/build.hpp"
#include "cablenet/solve/dynamics.hpp"
#include "choices.hpp"
#include "equilibrium.hpp"
#include "history_record.hpp"

namespace cablenet::app {
namespace {

class Trial {
public:
  explicit Trial(const scene::Scene& scene)
      : scene_(scene),
        time_(chosen_time(scene.time)),
        network_(network::build_network(scene)),
        partition_(partition::make_partition(network_, PETSC_COMM_WORLD)) {
    int rank = 0;
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    assembler_.emplace(partition::make_local_network(network_, partition_, rank), chosen_force_rule(time_),
                       PETSC_COMM_WORLD);
  }

  CoarseRun run() {
    CoarseRun result;
    result.trial.has_start = !scene_.starts_static || find_equilibrium();
    if (!result.trial.has_start) return result;
    record_.emplace(scene_, network_, *assembler_);
    if (scene_.is_static) look_at_start();
    if (!scene_.is_static && !go(result.trial)) return result;
    result.trial.is_done = true;
    result.trial.history = record_->table();
    result.bends = record_->bends();
    return result;
  }

private:
  bool find_equilibrium() {
    Equilibrium equilibrium(scene_, time_, *assembler_);
    Report report;
    return equilibrium.find_lengths(network_, report) && equilibrium.find(network_, report);
  }

  void look_at_start() {
    const system::Vector x = assembler_->make_vector(), v = assembler_->make_vector(), a = assembler_->make_vector();
    assembler_->fill_initial(x, v);
    record_->look(assembler_->observe(time_.start, x, v, a, true));
  }

  bool go(accuracy::Trial& trial) {
    solve::Dynamics::Settings settings{scene_.output.interval};
    settings.keeps_accounts = scene_.output.energy;
    settings.is_watched = false;
    solve::Dynamics dynamics(*assembler_, time_, settings);
    const solve::Verdict verdict = dynamics.run({
        [&](const solve::Instant& now) {
          const system::LocalState& state = assembler_->observe(now.t, now.x, now.v, now.a);
          if (scene_.output.energy) assembler_->look_at_energy();
          record_->look(state);
        },
        [](double, double, const solve::Counts&) {},
    });
    trial.work = static_cast<double>(dynamics.counts().newton);
    return verdict != solve::Verdict::failed;
  }

  const scene::Scene& scene_;
  scene::Time time_;
  network::Network network_;
  partition::Partition partition_;
  std::optional<system::Assembler> assembler_;
  std::optional<HistoryRecord> record_;
};

}   // namespace

CoarseRun run_coarsely(const scene::Scene& scene) {
  const Silence silence;
  try {
    return Trial(scene).run();
  } catch (const SolverError&) {
    return {};
  }
}

}   // namespace cablenet::app

#include "cablenet/app/report.hpp"

#include <fmt/format.h>
#include <petscsys.h>
#include <sys/resource.h>
#include <xxhash.h>
#include <yaml-cpp/yaml.h>

#include "text_file.hpp"

namespace cablenet::app {
namespace {

std::string petsc_version() {
  return fmt::format("{}.{}.{}", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR);
}

/// Sum and maximum over the ranks of the peak resident memory [MB].
std::pair<double, double> peak_memory(MPI_Comm communicator) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double mine = static_cast<double>(usage.ru_maxrss) / 1024;
  double sum = 0, most = 0;
  MPI_Allreduce(&mine, &sum, 1, MPI_DOUBLE, MPI_SUM, communicator);
  MPI_Allreduce(&mine, &most, 1, MPI_DOUBLE, MPI_MAX, communicator);
  return {sum, most};
}

void emit_partition(YAML::Emitter& yaml, const partition::Partition& partition) {
  const std::size_t ranks = partition.first_number.size() - 1;
  std::vector<int> nodes(ranks), elements(ranks, 0);
  for (std::size_t r = 0; r < ranks; ++r) nodes[r] = partition.first_number[r + 1] - partition.first_number[r];
  for (const int owner : partition.element_owner) ++elements[at(owner)];
  yaml << YAML::Key << "partition" << YAML::Value << YAML::BeginMap;
  yaml << YAML::Key << "free_nodes" << YAML::Value << YAML::Flow << nodes;
  yaml << YAML::Key << "elements" << YAML::Value << YAML::Flow << elements << YAML::EndMap;
}

void emit_seconds(YAML::Emitter& yaml, const char* key, const std::vector<Report::Phase>& phases,
                  double Report::Phase::*clock) {
  yaml << YAML::Key << key << YAML::Value << YAML::BeginMap;
  for (const auto& phase : phases)
    yaml << YAML::Key << phase.name << YAML::Value << fmt::format("{:.5g}", phase.*clock);
  yaml << YAML::EndMap;
}

void emit_statics(YAML::Emitter& yaml, const Report::Statics& statics) {
  const auto number = [](double value) { return fmt::format("{:.6g}", value); };
  yaml << YAML::Key << "statics" << YAML::Value << YAML::BeginMap;
  yaml << YAML::Key << "iterations" << YAML::Value << statics.iterations;
  yaml << YAML::Key << "largest_unbalanced_force_over_load" << YAML::Value << number(statics.imbalance);
  yaml << YAML::Key << "largest_load_on_a_node" << YAML::Value << number(statics.largest_load);
  yaml << YAML::Key << "frame_velocity" << YAML::Value << YAML::Flow << YAML::BeginSeq << number(statics.frame.x())
       << number(statics.frame.y()) << number(statics.frame.z()) << YAML::EndSeq << YAML::EndMap;
}

void emit_pretensions(YAML::Emitter& yaml, const std::vector<Report::Pretension>& all) {
  yaml << YAML::Key << "found_by_tension" << YAML::Value << YAML::BeginMap;
  for (const auto& [name, is_net, value, tension] : all) {
    yaml << YAML::Key << name << YAML::Value << YAML::Flow << YAML::BeginMap;
    yaml << YAML::Key << (is_net ? "slack" : "length_m") << YAML::Value << fmt::format("{:.17g}", value);
    yaml << YAML::Key << (is_net ? "mean_tension_N" : "tension_from_N") << YAML::Value
         << fmt::format("{:.12g}", tension);
    yaml << YAML::EndMap;
  }
  yaml << YAML::EndMap;
}

void emit_energy(YAML::Emitter& yaml, const EnergyReport& report) {
  const system::EnergySummary& energy = report.energy;
  const system::Energies& now = energy.now;
  const auto put = [&](const char* key, double value) {
    yaml << YAML::Key << key << YAML::Value << fmt::format("{:.6g}", value);
  };
  yaml << YAML::Key << "energy" << YAML::Value << YAML::BeginMap;
  put("moved_J", energy.moved);
  put("dissipated_J", now.dissipated);
  put("damping_J", now.damping);
  put("water_J", now.water);
  put("bed_J", now.bed);
  put("gained_J", energy.gained);
  if (energy.is_accounted) put("balance_over_moved", energy.moved > 0 ? energy.imbalance / energy.moved : 0);
  yaml << YAML::EndMap;
}

void emit_accuracy(YAML::Emitter& yaml, const Report::Accuracy& accuracy) {
  yaml << YAML::Key << "accuracy" << YAML::Value << YAML::BeginMap;
  yaml << YAML::Key << "wanted" << YAML::Value << fmt::format("{:.6g}", accuracy.wanted);
  yaml << YAML::Key << "estimated" << YAML::Value << fmt::format("{:.3g}", accuracy.estimated);
  yaml << YAML::Key << "worst_quantity" << YAML::Value << accuracy.quantity;
  if (!accuracy.stepping.empty()) yaml << YAML::Key << "steps" << YAML::Value << accuracy.stepping;
  if (!accuracy.elements.empty()) {
    yaml << YAML::Key << "elements" << YAML::Value << YAML::BeginMap;
    for (const auto& [cable, number] : accuracy.elements) yaml << YAML::Key << cable << YAML::Value << number;
    yaml << YAML::EndMap;
  }
  yaml << YAML::EndMap;
}

void emit_stiffness(YAML::Emitter& yaml, const std::vector<NamedStiffness>& all) {
  yaml << YAML::Key << "stiffness" << YAML::Value << YAML::BeginMap;
  yaml << YAML::Key << "rows_by_columns" << YAML::Value
       << "force x y z [N], moment x y z [N m] by displacement x y z [m], rotation x y z [rad]";
  yaml << YAML::Key << "of" << YAML::Value << YAML::BeginMap;
  for (const auto& [name, matrix] : all) {
    yaml << YAML::Key << name << YAML::Value << YAML::BeginSeq;
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      yaml << YAML::Flow << YAML::BeginSeq;
      for (Eigen::Index j = 0; j < matrix.cols(); ++j) yaml << fmt::format("{:.17g}", matrix(i, j));
      yaml << YAML::EndSeq;
    }
    yaml << YAML::EndSeq;
  }
  yaml << YAML::EndMap << YAML::EndMap;
}

void emit_economy(YAML::Emitter& yaml, const Economy& economy) {
  yaml << YAML::Key << "economy" << YAML::Value << YAML::BeginMap;
  yaml << YAML::Key << "sentences" << YAML::Value << economy.sentences;
  if (!economy.elements.empty()) {
    yaml << YAML::Key << "elements_for_1_percent" << YAML::Value << YAML::BeginMap;
    for (const auto& [cable, elements] : economy.elements) yaml << YAML::Key << cable << YAML::Value << elements;
    yaml << YAML::EndMap;
  }
  yaml << YAML::EndMap;
}

void emit_solution(YAML::Emitter& yaml, const Report& report) {
  if (report.statics) emit_statics(yaml, *report.statics);
  if (!report.pretensions.empty()) emit_pretensions(yaml, report.pretensions);
  if (!report.stiffness.empty()) emit_stiffness(yaml, report.stiffness);
  yaml << YAML::Key << "scheme" << YAML::Value << report.scheme;
  yaml << YAML::Key << "linear_solver" << YAML::Value << report.linear_solver;
  yaml << YAML::Key << "steps" << YAML::Value << report.counts.steps;
  yaml << YAML::Key << "rejected_steps" << YAML::Value << report.counts.rejected;
  yaml << YAML::Key << "newton_iterations" << YAML::Value << report.counts.newton;
  yaml << YAML::Key << "linear_iterations" << YAML::Value << report.counts.linear;
  if (report.energy) emit_energy(yaml, *report.energy);
  if (report.accuracy) emit_accuracy(yaml, *report.accuracy);
  if (!report.economy.sentences.empty()) emit_economy(yaml, report.economy);
  emit_seconds(yaml, "wall_seconds", report.phases, &Report::Phase::wall);
  emit_seconds(yaml, "cpu_seconds", report.phases, &Report::Phase::cpu);
}

bool is_silent = false;

bool speaks() {
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  return rank == 0 && !is_silent;
}

}   // namespace

Silence::Silence() { is_silent = true; }
Silence::~Silence() { is_silent = false; }

void tell(const std::string& text) {
  if (speaks()) fmt::print("{}\n", text);
}

void add_note(Report& report, const std::string& text) {
  if (text.empty()) return;
  if (speaks()) fmt::print(stderr, "cablenet: note: {}\n", text);
  report.notes.push_back(text);
}

void tell_economy(Report& report, const Economy& economy) {
  for (const std::string& sentence : economy.sentences) tell("economy: " + sentence);
  report.economy = economy;
}

std::string scene_hash(const scene::Scene& scene) {
  const XXH128_hash_t hash = XXH3_128bits(scene.text.data(), scene.text.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string describe(const scene::Scene& scene, const network::Network& network) {
  return fmt::format("{} cables, {} nets, {} nodes ({} held or moved), {} elements, {} bodies, {} unknowns",
                     scene.cables.size(), scene.nets.size(), network.position.size(), network.prescribed.size(),
                     network.elements.size(), network.bodies.size(), network.unknowns());
}

std::string describe(const Report::Statics& statics) {
  const Vector3& v = statics.frame;
  const std::string frame =
      v.isZero(0) ? "" : fmt::format(", moving at ({:.6g}, {:.6g}, {:.6g}) m/s", v.x(), v.y(), v.z());
  const char* const rounding = statics.ends_by_rounding ? ", which is rounding's share" : "";
  return fmt::format(
      "equilibrium{}: largest unbalanced force {:.2g} of the largest load on a node ({:.4g} N){}, {} iterations", frame,
      statics.imbalance, statics.largest_load, rounding, statics.iterations);
}

void write_report(const std::filesystem::path& path, const scene::Scene& scene, const network::Network& network,
                  const partition::Partition& partition, const Report& report, MPI_Comm communicator) {
  const auto [memory_sum, memory_most] = peak_memory(communicator);
  YAML::Emitter yaml;
  yaml << YAML::BeginMap;
  yaml << YAML::Key << "cablenet" << YAML::Value << CABLENET_VERSION;
  yaml << YAML::Key << "petsc" << YAML::Value << petsc_version();
  yaml << YAML::Key << "scene" << YAML::Value << scene.file;
  yaml << YAML::Key << "title" << YAML::Value << scene.title;
  yaml << YAML::Key << "scene_hash" << YAML::Value << scene_hash(scene);
  yaml << YAML::Key << "status" << YAML::Value << report.status;
  if (!report.message.empty()) yaml << YAML::Key << "message" << YAML::Value << report.message;
  if (!report.notes.empty()) yaml << YAML::Key << "notes" << YAML::Value << report.notes;
  yaml << YAML::Key << "time_reached" << YAML::Value << fmt::format("{:.17g}", report.reached);
  yaml << YAML::Key << "ranks" << YAML::Value << partition.first_number.size() - 1;
  yaml << YAML::Key << "nodes" << YAML::Value << network.position.size();
  yaml << YAML::Key << "elements" << YAML::Value << network.elements.size();
  yaml << YAML::Key << "bodies" << YAML::Value << network.bodies.size();
  yaml << YAML::Key << "unknowns" << YAML::Value << network.unknowns();
  emit_partition(yaml, partition);
  emit_solution(yaml, report);
  yaml << YAML::Key << "peak_memory_MB" << YAML::Value << YAML::BeginMap;
  yaml << YAML::Key << "all_ranks" << YAML::Value << fmt::format("{:.1f}", memory_sum);
  yaml << YAML::Key << "largest_rank" << YAML::Value << fmt::format("{:.1f}", memory_most) << YAML::EndMap
       << YAML::EndMap;

  write_text_file(path, std::string(yaml.c_str()) + "\n", communicator);
}

}   // namespace cablenet::app

#include "cablenet/app/run.hpp"

#include <fmt/format.h>
#include <petscsys.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "accurate_run.hpp"
#include "cablenet/accuracy/fineness.hpp"
#include "cablenet/app/command_line.hpp"
#include "cablenet/app/python_part.hpp"
#include "cablenet/app/simulation.hpp"
#include "cablenet/base/errors.hpp"
#include "cablenet/base/floating_point.hpp"
#include "cablenet/network/build.hpp"
#include "cablenet/network/drawn_notes.hpp"
#include "cablenet/network/economy.hpp"
#include "cablenet/petsc/options.hpp"
#include "cablenet/petsc/session.hpp"
#include "cablenet/scene/read.hpp"
#include "cablenet/scene/schema.hpp"
#include "cablenet/solve/alpha_stepper.hpp"
#include "cablenet/solve/own_options.hpp"

namespace cablenet::app {
namespace {

int this_rank() {
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  return rank;
}

void print_error(const std::string& message) {
  if (this_rank() == 0) fmt::print(stderr, "cablenet: error: {}\n", message);
}

/// HDF5 hangs or crashes in MPI_Finalize when it holds a file that could not be written.
[[noreturn]] void leave_without_finalizing(int status) {
  std::fflush(nullptr);
  MPI_Barrier(PETSC_COMM_WORLD);
  std::_Exit(status);
}

/// Reads a file into `text`.  @returns false if it cannot be read; `text` is then the reason
bool slurp(const std::string& path, std::string& text) {
  if (std::filesystem::is_directory(path)) {
    text = fmt::format("{} is a folder; name a scene, a YAML file", path);
    return false;
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  if (file) content << file.rdbuf();
  text = file ? content.str() : fmt::format("{} cannot be read; name a scene, a YAML file", path);
  return static_cast<bool>(file);
}

/// Rank 0 reads, all get the text.
scene::Scene load_scene(const std::string& path) {
  std::string text;
  long found[2] = {0, 0};
  if (this_rank() == 0) {
    found[0] = slurp(path, text) ? 1 : 0;
    found[1] = static_cast<long>(text.size());
  }
  MPI_Bcast(found, 2, MPI_LONG, 0, PETSC_COMM_WORLD);
  text.resize(static_cast<std::size_t>(found[1]));
  MPI_Bcast(text.data(), static_cast<int>(found[1]), MPI_CHAR, 0, PETSC_COMM_WORLD);
  if (found[0] == 0) throw InputError(text);
  scene::Scene scene = scene::read_scene(text, path);
  if (this_rank() == 0)
    for (const std::string& note : scene.notes) fmt::print(stderr, "cablenet: note: {}\n", note);
  return scene;
}

int check_scene(const CommandLine& line) {
  scene::Scene scene = load_scene(line.scene);
  const bool is_open = scene.accuracy && accuracy::is_open(scene);
  if (is_open) scene = first_choice(scene);
  const network::Network network = network::build_network(scene);
  if (this_rank() != 0) return 0;
  for (const std::string& note : network::drawn_notes(scene, network)) fmt::print(stderr, "cablenet: note: {}\n", note);
  fmt::print("{}: valid: {}\n", line.scene, describe(scene, network));
  if (is_open) {
    fmt::print("This is its first coarse run: elements and steps are chosen for its accuracy when it is run.\n");
    return 0;
  }
  for (const std::string& sentence : network::drawn_economy(scene, network)) fmt::print("economy: {}\n", sentence);
  return 0;
}

/// PETSc prints the help of a solver when it is set up from options.
int print_solver_help() {
  solve::AlphaStepper::show_options(PETSC_COMM_WORLD);
  solve::show_own_options(PETSC_COMM_WORLD);
  return 0;
}

void report_unused_options() {
  if (this_rank() != 0) return;
  for (const std::string& option : petsc::unused_options())
    fmt::print(stderr, "cablenet: note: option {} was not used by anything; is it spelt right?\n", option);
}

int execute(const CommandLine& line) {
  if (line.command == Command::check) return check_scene(line);
  if (line.command == Command::solver_help) return print_solver_help();
  if (line.command == Command::run) {
    const scene::Scene scene = load_scene(line.scene);
    const int status = scene.accuracy ? simulate_accurately(scene, line.directory) : simulate(scene, line.directory);
    report_unused_options();
    return status;
  }
  if (this_rank() != 0) return 0;
  const bool wants_keys = line.command == Command::schema;
  const std::string keys = !wants_keys ? "" : line.wants_markdown ? scene::key_reference() : scene::json_schema();
  std::fputs(wants_keys ? keys.c_str() : line.text.c_str(), stdout);
  return 0;
}

}   // namespace

int run(const std::string& program, const std::vector<std::string>& words) {
  flush_denormals();
  std::optional<CommandLine> line;
  std::string problem;
  try {
    line = parse_command_line(words);
  } catch (const InputError& error) {
    problem = error.what();
  }
  if (line && line->command == Command::chart) return become_python_part("chart", line->words);
  const petsc::Session session(program, line ? line->petsc_options : std::vector<std::string>{});
  try {
    if (!line) throw InputError(problem);
    return execute(*line);
  } catch (const InputError& error) {
    print_error(error.what());
    return 2;
  } catch (const SolverError& error) {
    print_error(error.what());
    return 3;
  } catch (const OutputError& error) {
    print_error(error.what());
    leave_without_finalizing(4);
  }
}

}   // namespace cablenet::app

#include "cablenet/app/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>

#include "cablenet/base/errors.hpp"
#include "cablenet/solve/own_options.hpp"
#include "cablenet/solve/relaxation.hpp"

namespace cablenet::app {
namespace {

constexpr auto about =
    "cablenet: dynamics of networks of cables, on one core or many\n"
    "  mpirun -n N cablenet run SCENE [-o DIR] [PETSc options]\n"
    "Exit status: 0 done, 2 the scene or the command line is wrong, 3 the solver could not go on,\n"
    "4 output could not be written.";

constexpr auto chart_command = "chart";

bool is_petsc_option(const std::string& word) {
  return word.size() > 2 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1]));
}

bool is_value(const std::string& word) {
  const bool dashed =
      word.size() > 1 && word[0] == '-' && !std::isdigit(static_cast<unsigned char>(word[1])) && word[1] != '.';
  const std::string end = std::filesystem::path(word).extension().string();
  return !dashed && end != ".yaml" && end != ".yml";
}

/// Takes the PETSc options out of the words: CLI11 would read -options_file as -o ptions_file.
std::vector<std::string> take_petsc_options(std::vector<std::string>& words) {
  std::vector<std::string> options, others;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!is_petsc_option(words[i])) {
      others.push_back(words[i]);
      continue;
    }
    options.push_back(words[i]);
    if (words[i] != "-help" && i + 1 < words.size() && is_value(words[i + 1])) options.push_back(words[++i]);
  }
  words = others;
  return options;
}

/// @throws InputError if the command takes no PETSc options and there are some.
Command command_of(const CLI::App& app, const CommandLine& line) {
  if (app.got_subcommand("run")) return line.scene.empty() ? Command::solver_help : Command::run;
  const std::string name = app.get_subcommands().front()->get_name();
  if (!line.petsc_options.empty())
    throw InputError(fmt::format("{} takes no option {}; see cablenet --help", name, line.petsc_options.front()));
  return name == "check" ? Command::check : Command::schema;
}

/// Python reads what follows `chart`.
bool is_chart(const std::vector<std::string>& given, CommandLine& line) {
  if (given.empty() || given.front() != chart_command) return false;
  line.command = Command::chart;
  line.words.assign(given.begin() + 1, given.end());
  return true;
}

/// The program's own options beside PETSc's, for --help.
std::string options_text() {
  std::string text = "Options beside PETSc's own (those: cablenet run -help):\n";
  for (const solve::OwnOption* option : solve::own_options())
    text += fmt::format("  {}\n      {};\n      {}; default: {}\n", option->text.name, option->text.help,
                        option->expected, option->fallback);
  return text + fmt::format(
                    "With {} before its name (-{}ts_max_steps 1000) an option reaches the solvers that let a\n"
                    "network settle in time, statics' last resort.",
                    solve::relaxation_prefix, solve::relaxation_prefix);
}

}   // namespace

CommandLine parse_command_line(const std::vector<std::string>& given) {
  CommandLine line;
  if (is_chart(given, line)) return line;
  std::vector<std::string> words = given;
  line.petsc_options = take_petsc_options(words);
  CLI::App app{about, "cablenet"};
  app.set_version_flag("--version", std::string("cablenet ") + CABLENET_VERSION);
  app.require_subcommand(1);
  CLI::App* run =
      app.add_subcommand("run", "solve a scene; PETSc options may follow (-ts_dt 1e-3, -snes_monitor, -log_view, ...)");
  const bool wants_petsc_help =
      std::find(line.petsc_options.begin(), line.petsc_options.end(), "-help") != line.petsc_options.end();
  CLI::Option* scene = run->add_option("SCENE", line.scene, "the scene, a YAML file");
  if (!wants_petsc_help) scene->required();
  run->add_option("-o", line.directory, "folder for the results; default: SCENE's name with .out, where you are");
  run->footer(options_text());
  CLI::App* check = app.add_subcommand("check", "read and validate a scene, print its size, write nothing");
  check->add_option("SCENE", line.scene, "the scene, a YAML file")->required();
  CLI::App* schema = app.add_subcommand("schema", "print a JSON Schema of scene files, for editors");
  schema->add_flag("--markdown", line.wants_markdown, "print the reference of all keys instead");
  app.add_subcommand(chart_command, "chart the cost of a scene over its accuracy, and tell the cheapest settings");
  try {
    std::reverse(words.begin(), words.end());
    app.parse(words);
  } catch (const CLI::CallForHelp&) {
    const auto subcommands = app.get_subcommands();
    line.text = subcommands.empty() ? app.help() : subcommands.front()->help();
    return line;
  } catch (const CLI::CallForVersion& version) {
    line.command = Command::version;
    line.text = std::string(version.what()) + "\n";
    return line;
  } catch (const CLI::ParseError& error) {
    throw InputError(fmt::format("{}; see cablenet --help", error.what()));
  }
  line.command = command_of(app, line);
  if (line.directory.empty()) line.directory = std::filesystem::path(line.scene).stem().string() + ".out";
  return line;
}

}   // namespace cablenet::app

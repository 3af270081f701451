#pragma once
#include <string>
#include <vector>

namespace cablenet::app {

enum class Command { run, check, schema, chart, help, version, solver_help };

struct CommandLine {
  Command command = Command::help;
  std::string scene;                        ///< path
  std::string directory;                    ///< of the results
  std::vector<std::string> petsc_options;   ///< as given
  std::vector<std::string> words;           ///< of chart, which reads them itself
  bool wants_markdown = false;              ///< of schema
  std::string text;                         ///< to print for help and version
};

/// cablenet run SCENE [-o DIR] [PETSc options] | check SCENE | schema [--markdown] | chart WORDS | --help | --version.
/// A word that starts with one dash and has more than one letter is a PETSc option; the next word is its value unless
/// it is an option too or a file in YAML.
/// @throws InputError if it makes no sense.
CommandLine parse_command_line(const std::vector<std::string>& words);

}   // namespace cablenet::app

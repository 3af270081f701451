#include "cablenet/app/python_part.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "cablenet/base/errors.hpp"

namespace cablenet::app {
namespace {

/// What launchers of several ranks tell each of them.
constexpr const char* rank_variables[] = {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"};

void refuse_launchers(const std::string& name) {
  for (const char* variable : rank_variables)
    if (std::getenv(variable) != nullptr)
      throw InputError(
          fmt::format("{} starts its runs by itself; start it without mpirun, and give it --ranks N", name));
}

/// An installed program finds its parts where CMake installs them, that of a build folder finds them there.
std::filesystem::path part_folder(const std::filesystem::path& program, const std::string& name) {
  const std::filesystem::path beside = program.parent_path();
  const auto installed = (beside / CABLENET_SHARE / name).lexically_normal();
  for (const auto& folder : {installed, beside / "share" / "cablenet" / name})
    if (std::filesystem::is_directory(folder)) return folder;
  throw InputError(
      fmt::format("{} is written in Python and belongs into {}, where it is not; install cablenet by cmake --install",
                  name, installed.string()));
}

[[noreturn]] void become(const std::vector<std::string>& command, const std::string& name) {
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execv(words.front(), words.data());
  throw InputError(
      fmt::format("{} needs Python 3, and {} cannot be started ({}); install it (Debian: python3 python3-numpy "
                  "python3-yaml python3-matplotlib), or name another one in the environment's CABLENET_PYTHON",
                  name, command.front(), std::strerror(errno)));
}

}   // namespace

int become_python_part(const std::string& name, const std::vector<std::string>& words) {
  try {
    refuse_launchers(name);
    const auto program = std::filesystem::read_symlink("/proc/self/exe");
    const char* const chosen = std::getenv("CABLENET_PYTHON");
    // -B: what is installed may not be written to.
    std::vector<std::string> command{chosen != nullptr ? chosen : "/usr/bin/python3", "-B",
                                     part_folder(program, name).string(), program.string()};
    command.insert(command.end(), words.begin(), words.end());
    become(command, name);
  } catch (const InputError& error) {
    fmt::print(stderr, "cablenet: error: {}\n", error.what());
    return 2;
  }
}

}   // namespace cablenet::app

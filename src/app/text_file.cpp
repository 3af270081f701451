#include "text_file.hpp"

#include <fmt/format.h>

#include <fstream>

#include "cablenet/base/errors.hpp"

namespace cablenet::app {
namespace {

void write_text(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path part = path.string() + ".tmp";
  std::ofstream file(part);
  file << text;
  file.close();
  std::error_code problem;
  if (file) std::filesystem::rename(part, path, problem);
  if (!file || problem) throw OutputError(fmt::format("{} cannot be written", path.string()));
}

}   // namespace

void write_text_file(const std::filesystem::path& path, const std::string& text, MPI_Comm communicator) {
  int rank = 0, failed = 0;
  MPI_Comm_rank(communicator, &rank);
  std::string problem;
  if (rank == 0) try {
      write_text(path, text);
    } catch (const OutputError& error) {
      problem = error.what();
      failed = 1;
    }
  MPI_Bcast(&failed, 1, MPI_INT, 0, communicator);
  if (failed) throw OutputError(problem);
}

}   // namespace cablenet::app

#pragma once
#include <mpi.h>

#include <filesystem>
#include <string>

namespace cablenet::app {

/// Rank 0 writes the text to `path`, under another name until it is complete.  Collective.
/// @throws OutputError on every rank alike.
void write_text_file(const std::filesystem::path& path, const std::string& text, MPI_Comm communicator);

}   // namespace cablenet::app

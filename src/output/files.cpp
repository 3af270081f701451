#include "files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <regex>
#include <system_error>
#include <vector>

#include "cablenet/base/errors.hpp"

namespace cablenet::output {
namespace fs = std::filesystem;
namespace {

void sync_and_close(int descriptor, const fs::path& path) {
  const int sync_error = fsync(descriptor) == 0 ? 0 : errno;
  const int close_error = ::close(descriptor) == 0 ? 0 : errno;
  if (sync_error) fail("write", path, sync_error);
  if (close_error) fail("close", path, close_error);
}

void sync_directory(const fs::path& directory) {
  const int descriptor = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) fail("open", directory, errno);
  sync_and_close(descriptor, directory);
}

bool is_series_file(const std::string& name) {
  static const std::regex pattern(
      R"((cables|bodies)\.xmf(\.tmp)?|result\.h5(\.tmp)?|mesh\.h5(\.part)?|frames_\d{4,}\.h5(\.part)?)");
  return std::regex_match(name, pattern);
}

}   // namespace

void fail(std::string_view action, const fs::path& path, int error_code) {
  throw OutputError(fmt::format("cannot {} {}: {}", action, path.string(), std::strerror(error_code)));
}

void write_all(int descriptor, std::string_view text, const fs::path& path) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("write", path, errno);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void publish(const fs::path& from, const fs::path& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) fail("rename to", to, errno);
  sync_directory(to.has_parent_path() ? to.parent_path() : ".");
}

void replace_text(const fs::path& path, std::string_view head, std::string_view body, std::string_view tail) {
  const fs::path temporary = path.string() + ".tmp";
  const int descriptor = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) fail("create", temporary, errno);
  for (const auto part : {head, body, tail}) write_all(descriptor, part, temporary);
  sync_and_close(descriptor, temporary);
  publish(temporary, path);
}

void prepare_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) fail("create directory", directory, error.value());
  const auto remove = [&error](const fs::path& path) {
    fs::remove(path, error);
    if (error) fail("remove", path, error.value());
  };
  // The indices go first, so that they never name a file that is gone.
  for (const char* index : {"cables.xmf", "bodies.xmf"}) remove(directory / index);
  std::vector<fs::path> stale;
  auto entry = fs::directory_iterator(directory, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (is_series_file(entry->path().filename())) stale.push_back(entry->path());
  if (error) fail("list", directory, error.value());
  for (const auto& path : stale) remove(path);
  if (access(directory.c_str(), W_OK | X_OK) != 0) fail("write into", directory, errno);
}

}   // namespace cablenet::output

#include "cablenet/output/history.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "cablenet/base/errors.hpp"
#include "files.hpp"

namespace cablenet::output {

History::History(std::filesystem::path path, std::span<const std::string> columns)
    : path_(std::move(path)), columns_(columns.size()) {
  descriptor_ = open(path_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail("create", path_, errno);
  try {
    append(fmt::format("{}\n", fmt::join(columns, ",")));
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

History::~History() { ::close(descriptor_); }

void History::write(std::span<const double> row) {
  if (row.size() != columns_)
    throw std::logic_error(fmt::format("{}: {} values for {} columns", path_.string(), row.size(), columns_));
  std::string line;
  for (const double value : row) fmt::format_to(std::back_inserter(line), "{}{:.17g}", line.empty() ? "" : ",", value);
  append(line + "\n");
}

void History::append(std::string_view line) {
  try {
    write_all(descriptor_, line, path_);
  } catch (const OutputError&) {
    // Half a number would be read as a wrong one, so the row is cut off.  If that fails, nothing more can be done.
    [[maybe_unused]] const int ignored = ftruncate(descriptor_, size_);
    throw;
  }
  size_ += static_cast<std::int64_t>(line.size());
}

}   // namespace cablenet::output

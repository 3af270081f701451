#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

/// A table of numbers that grows by a row at a time: history.csv.  Tests: tests/parallel/history_test.cpp
namespace cablenet::output {

/// Comma-separated, exact (%.17g).  Each row is with the system when write() returns, so killing the run loses none.
/// Not collective: for one rank.
class History {
public:
  /// Replaces `path` by a file with a header row.
  /// @param columns  names without commas and line breaks
  /// @throws OutputError if that fails.
  History(std::filesystem::path path, std::span<const std::string> columns);
  ~History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  /// Appends a row.
  /// @param row  one value per column
  /// @throws OutputError if that fails; the file then ends with the row before.
  void write(std::span<const double> row);

private:
  void append(std::string_view line);

  std::filesystem::path path_;
  std::size_t columns_;
  std::int64_t size_ = 0;   ///< of the file [bytes]
  int descriptor_ = -1;
};

}   // namespace cablenet::output

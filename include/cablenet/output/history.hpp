#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

/// history.csv is a table of numbers that grows row by row.  Tests: tests/parallel/history_test.cpp
namespace cablenet::output {

/// The numbers are separated by commas and exact (%.17g).  The operating system has a row when write() returns, so a
/// run that is killed loses no row.
/// Not collective: one rank has the history.
class History {
public:
  /// Replaces `path` by a file with a header row.
  /// @param columns  names without commas and line breaks
  /// @throws OutputError if the file cannot be written
  History(std::filesystem::path path, std::span<const std::string> columns);
  ~History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  /// Appends a row.
  /// @param row  one value per column
  /// @throws OutputError if the row cannot be written; the file then ends with the row before
  void write(std::span<const double> row);

private:
  void append(std::string_view line);

  std::filesystem::path path_;
  std::size_t columns_;
  std::int64_t size_ = 0;   ///< of the file [bytes]
  int descriptor_ = -1;
};

}   // namespace cablenet::output

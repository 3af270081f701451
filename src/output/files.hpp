#pragma once
#include <filesystem>
#include <string_view>

/// POSIX file operations whose results survive a crash.  Every return code is checked.  None is collective.
namespace cablenet::output {

/// @throws OutputError "cannot ACTION PATH: REASON" with the reason of `error_code`, an errno.
[[noreturn]] void fail(std::string_view action, const std::filesystem::path& path, int error_code);

/// Writes all of `text`.  @throws OutputError
void write_all(int descriptor, std::string_view text, const std::filesystem::path& path);

/// Gives a complete file its final name, and replaces a file of that name.  The name is on the disk on return.
/// @throws OutputError
void publish(const std::filesystem::path& from, const std::filesystem::path& to);

/// Replaces `path` by head + body + tail.  A reader sees either the old file or the whole new one.
/// @throws OutputError
void replace_text(const std::filesystem::path& path, std::string_view head, std::string_view body,
                  std::string_view tail);

/// Makes `directory` and removes from it the files that an earlier Series wrote.  Other files stay.
/// @throws OutputError
void prepare_directory(const std::filesystem::path& directory);

}   // namespace cablenet::output

#pragma once
#include <hdf5.h>
#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// This header has the part of HDF5 that a series needs.  Every return code is checked.
/// HDF5 itself prints nothing: the OutputError holds its innermost reason.
namespace cablenet::output {

/// The rows of a dataset, of which each rank has one contiguous block, possibly an empty one.
struct Rows {
  std::int64_t total;
  std::int64_t first;   ///< of this rank's block
  std::int64_t local;
};

/// For `columns`: the dataset has one value for each row, and no second dimension.
constexpr int one_dimensional = 0;

/// A new HDF5 file.  Every member but the destructor is collective over the communicator; objects are named by
/// absolute paths.  All throw OutputError, possibly on one rank alone.
class Hdf5File {
public:
  /// Replaces an existing file.
  Hdf5File(MPI_Comm communicator, const std::filesystem::path& path);
  /// Leaves a file that was not closed to MPI_Finalize, because closing would wait for ranks that may never come.
  ~Hdf5File() = default;
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  void create_group(const std::string& name);

  /// A contiguous dataset of shape (rows.total, columns), or (rows.total) where `columns` is one_dimensional.
  /// @param values  this rank's rows, row-major
  void write_rows(const std::string& name, const Rows& rows, int columns, std::span<const double> values);
  void write_rows(const std::string& name, const Rows& rows, int columns, std::span<const int> values);
  /// A dataset of UTF-8 strings of one length, padded with zeros.
  /// @param rows    all rows on one rank, and none on the others
  /// @param values  all strings, the same on every rank
  void write_strings(const std::string& name, const Rows& rows, const std::vector<std::string>& values);

  /// @param value  the same on every rank
  void set_attribute(const std::string& object, const std::string& name, double value);
  void set_attribute(const std::string& object, const std::string& name, std::int64_t value);
  void set_attribute(const std::string& object, const std::string& name, std::string_view value);

  /// Makes `name` a link to `target` in another file.
  /// @param file  path relative to this file's directory
  void link(const std::string& name, const std::string& file, const std::string& target);

  /// Closes the file.  All of it is on the disk when this has returned on every rank.
  void close();

private:
  void write_block(const std::string& name, const Rows& rows, int columns, hid_t type, const void* values);
  void write_attribute(const std::string& object, const std::string& name, hid_t type, const void* value);
  hid_t check(hid_t result, std::string_view what) const;

  std::filesystem::path path_;
  hid_t file_ = H5I_INVALID_HID;
};

}   // namespace cablenet::output

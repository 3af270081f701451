#include "hdf5_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "cablenet/base/errors.hpp"

namespace cablenet::output {
namespace {

/// Owns an HDF5 object that is not a file.
class Hdf5Object {
public:
  using Close = herr_t (*)(hid_t);
  Hdf5Object(hid_t id, Close how) : id_(id), close_(how) {}
  // While an exception passes, the object is left open: closing may write metadata and wait for the other ranks.
  ~Hdf5Object() {
    if (id_ >= 0 && std::uncaught_exceptions() == 0) close_(id_);
  }
  Hdf5Object(const Hdf5Object&) = delete;
  Hdf5Object& operator=(const Hdf5Object&) = delete;

  operator hid_t() const { return id_; }
  /// Closes the object where that may fail.  @returns HDF5's status
  herr_t close() { return close_(std::exchange(id_, H5I_INVALID_HID)); }

private:
  hid_t id_;
  Close close_;
};

std::string innermost_reason() {
  std::string reason;
  const auto keep_first = [](unsigned depth, const H5E_error2_t* error, void* out) -> herr_t {
    if (depth == 0 && error->desc) *static_cast<std::string*>(out) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
  return reason.empty() ? "no reason given" : reason;
}

hid_t string_type(std::size_t length) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  const bool good = type >= 0 && H5Tset_size(type, length) >= 0 && H5Tset_strpad(type, H5T_STR_NULLPAD) >= 0 &&
                    H5Tset_cset(type, H5T_CSET_UTF8) >= 0;
  return good ? type : H5I_INVALID_HID;
}

void require_block(const std::string& name, const Rows& rows, int columns, std::size_t given) {
  if (static_cast<std::int64_t>(given) != rows.local * std::max(1, columns))
    throw std::logic_error(fmt::format("{}: {} values for {} rows of {}", name, given, rows.local, columns));
}

}   // namespace

hid_t Hdf5File::check(hid_t result, std::string_view what) const {
  if (result >= 0) return result;
  const std::string reason = innermost_reason();
  // MPI loses the reason of a failed write.  Mostly it is a full disk, so the message tells the free space.
  std::error_code unknown;
  const auto space = std::filesystem::space(path_.has_parent_path() ? path_.parent_path() : ".", unknown);
  const std::string free = unknown ? "" : fmt::format(" ({} bytes free on its disk)", space.available);
  throw OutputError(fmt::format("cannot write {}: {}: {}{}", path_.string(), what, reason, free));
}

Hdf5File::Hdf5File(MPI_Comm communicator, const std::filesystem::path& path) : path_(path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Hdf5Object access(check(H5Pcreate(H5P_FILE_ACCESS), "access list"), H5Pclose);
  check(H5Pset_fapl_mpio(access, communicator, MPI_INFO_NULL), "MPI access");
  check(H5Pset_coll_metadata_write(access, true), "collective metadata");
  check(H5Pset_all_coll_metadata_ops(access, true), "collective metadata");
  file_ = check(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), "create");
}

void Hdf5File::create_group(const std::string& name) {
  Hdf5Object group(check(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), name), H5Gclose);
  check(group.close(), name);
}

void Hdf5File::write_rows(const std::string& name, const Rows& rows, int columns, std::span<const double> values) {
  require_block(name, rows, columns, values.size());
  write_block(name, rows, columns, H5T_NATIVE_DOUBLE, values.data());
}

void Hdf5File::write_rows(const std::string& name, const Rows& rows, int columns, std::span<const int> values) {
  require_block(name, rows, columns, values.size());
  write_block(name, rows, columns, H5T_NATIVE_INT, values.data());
}

void Hdf5File::write_block(const std::string& name, const Rows& rows, int columns, hid_t type, const void* values) {
  using Shape = std::array<hsize_t, 2>;
  const int rank = columns == one_dimensional ? 1 : 2;
  const auto width = static_cast<hsize_t>(std::max(1, columns));
  const Shape whole{static_cast<hsize_t>(rows.total), width};
  const Shape block{static_cast<hsize_t>(rows.local), width};
  const Shape start{static_cast<hsize_t>(rows.first), 0};
  const Hdf5Object file_space(check(H5Screate_simple(rank, whole.data(), nullptr), name), H5Sclose);
  const Hdf5Object memory_space(check(H5Screate_simple(rank, block.data(), nullptr), name), H5Sclose);
  if (rows.local > 0) {
    check(H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr), name);
  } else {
    check(H5Sselect_none(file_space), name);
    check(H5Sselect_none(memory_space), name);
  }
  const Hdf5Object creation(check(H5Pcreate(H5P_DATASET_CREATE), name), H5Pclose);
  check(H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER), name);
  const Hdf5Object transfer(check(H5Pcreate(H5P_DATASET_XFER), name), H5Pclose);
  check(H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE), name);
  Hdf5Object dataset(check(H5Dcreate2(file_, name.c_str(), type, file_space, H5P_DEFAULT, creation, H5P_DEFAULT), name),
                     H5Dclose);
  // A dataset without rows has no address to write to.
  if (rows.total > 0) check(H5Dwrite(dataset, type, memory_space, file_space, transfer, values), name);
  check(dataset.close(), name);
}

void Hdf5File::write_strings(const std::string& name, const Rows& rows, const std::vector<std::string>& values) {
  std::size_t length = 1;
  for (const auto& value : values) length = std::max(length, value.size());
  std::string padded;
  for (const auto& value : values) padded += value + std::string(length - value.size(), '\0');
  const Hdf5Object type(check(string_type(length), name), H5Tclose);
  write_block(name, rows, one_dimensional, type, padded.data());
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, double value) {
  write_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, std::int64_t value) {
  write_attribute(object, name, H5T_NATIVE_INT64, &value);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, std::string_view value) {
  const std::string terminated(value);
  const Hdf5Object type(check(string_type(std::max<std::size_t>(1, value.size())), name), H5Tclose);
  write_attribute(object, name, type, terminated.c_str());
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name, hid_t type, const void* value) {
  const Hdf5Object space(check(H5Screate(H5S_SCALAR), name), H5Sclose);
  Hdf5Object attribute(
      check(H5Acreate_by_name(file_, object.c_str(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
            name),
      H5Aclose);
  check(H5Awrite(attribute, type, value), name);
  check(attribute.close(), name);
}

void Hdf5File::link(const std::string& name, const std::string& file, const std::string& target) {
  check(H5Lcreate_external(file.c_str(), target.c_str(), file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT), name);
}

void Hdf5File::close() {
  // H5Fclose alone would leave the data in the operating system's cache.
  check(H5Fflush(file_, H5F_SCOPE_LOCAL), "flush");
  check(H5Fclose(std::exchange(file_, H5I_INVALID_HID)), "close");
}

}   // namespace cablenet::output

#pragma once
#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cablenet/base/errors.hpp"
#include "cablenet/base/linear_algebra.hpp"

namespace cablenet {

/// An archive holds what a run keeps between steps, as a list of named numbers in a fixed order.  An object saves and
/// loads itself with one function, void archive(Archive&), which passes each of its values to item().  A new archive
/// saves; one made from entries loads them in the order in which they were saved.  Each rank has its own archive.
/// Tests: tests/unit/archive_test.cpp
class Archive {
public:
  using Numbers = std::variant<std::vector<double>, std::vector<long>>;
  struct Entry {
    std::string name;
    Numbers numbers;
  };

  Archive() = default;
  /// An archive that loads from `entries`.
  explicit Archive(std::vector<Entry> entries) : entries_(std::move(entries)), is_loading_(true) {}

  bool is_loading() const { return is_loading_; }
  const std::vector<Entry>& entries() const { return entries_; }
  /// Saves `value`, or sets it to what was saved.  A vector is resized to the saved size; a span must already have it.
  /// @throws InputError if the next saved item has another name, type or size
  void item(const char* name, double& value) { item(name, std::span(&value, 1)); }
  void item(const char* name, long& value) { numbers(name, std::span(&value, 1)); }
  void item(const char* name, int& value) { converted(name, value); }
  void item(const char* name, bool& value) { converted(name, value); }
  void item(const char* name, Vector3& value) { item(name, std::span(value.data(), 3)); }
  void item(const char* name, std::span<double> values) { numbers(name, values); }
  void item(const char* name, std::vector<double>& values) {
    if (is_loading_) values.resize(next<double>(name).size());
    item(name, std::span(values));
  }

private:
  template <class T>
  void converted(const char* name, T& value) {
    long number = static_cast<long>(value);
    item(name, number);
    value = static_cast<T>(number);
  }
  template <class T>
  void numbers(const char* name, std::span<T> values) {
    if (!is_loading_) {
      entries_.push_back({name, std::vector<T>(values.begin(), values.end())});
      return;
    }
    const std::vector<T>& saved = next<T>(name);
    if (saved.size() != values.size())
      throw InputError("the saved state has " + std::to_string(saved.size()) + " numbers of " + name +
                       ", this run has " + std::to_string(values.size()) + "; resume with the same scene and ranks");
    std::copy(saved.begin(), saved.end(), values.begin());
    ++read_;
  }
  template <class T>
  const std::vector<T>& next(const char* name) const {
    const Entry* const entry = read_ < entries_.size() ? &entries_[read_] : nullptr;
    if (entry == nullptr || entry->name != name || !std::holds_alternative<std::vector<T>>(entry->numbers))
      throw InputError(std::string("the saved state has ") + (entry == nullptr ? "no more" : entry->name) + " where " +
                       name + " is expected; resume with the same scene and program");
    return std::get<std::vector<T>>(entry->numbers);
  }

  std::vector<Entry> entries_;
  std::size_t read_ = 0;
  bool is_loading_ = false;
};

}   // namespace cablenet

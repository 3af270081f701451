#pragma once
#include <compare>
#include <concepts>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

/// Each index space has a type of its own, so that a number of one cannot be used in another.
/// Tests: tests/unit/index_test.cpp
namespace cablenet {

/// A number in one index space.  A default-constructed index means "none": exists() is false.
template <class Space>
class Index {
public:
  constexpr Index() = default;
  constexpr explicit Index(int value) : value_(value) {}

  constexpr int value() const { return value_; }
  constexpr bool exists() const { return value_ >= 0; }
  constexpr auto operator<=>(const Index&) const = default;
  constexpr Index& operator++() {
    ++value_;
    return *this;
  }
  friend constexpr Index operator+(Index index, int step) { return Index(index.value_ + step); }
  friend constexpr int operator-(Index one, Index other) { return one.value_ - other.value_; }

private:
  int value_ = -1;
};

/// A node of the whole network, as network::Network numbers it.
using SceneNode = Index<struct SceneNodeSpace>;
/// A node on this rank, as partition::LocalNetwork numbers it.
using LocalNode = Index<struct LocalNodeSpace>;
/// A free node or a body, counted over all ranks in the order of the solver's unknowns.
using SolverNumber = Index<struct SolverNumberSpace>;
/// A scalar unknown in this rank's part of the solver's vectors.
using Unknown = Index<struct UnknownSpace>;

/// Converts a count or a position to the index type of the standard containers.
template <std::signed_integral Position>
constexpr std::size_t at(Position position) {
  return static_cast<std::size_t>(position);
}
template <class Space>
constexpr std::size_t at(Index<Space> index) {
  return static_cast<std::size_t>(index.value());
}

/// A table with one value for each index of one space.
template <class Key, class Value>
class Table {
public:
  Table() = default;
  explicit Table(int size, const Value& value = Value()) : values_(at(size), value) {}

  decltype(auto) operator[](Key key) { return values_[at(key)]; }
  decltype(auto) operator[](Key key) const { return values_[at(key)]; }
  /// Appends a value.  @returns its index
  Key push_back(Value value) {
    values_.push_back(std::move(value));
    return Key(size() - 1);
  }
  void resize(int size, const Value& value = Value()) { values_.resize(at(size), value); }
  bool operator==(const Table&) const = default;
  int size() const { return static_cast<int>(values_.size()); }
  bool empty() const { return values_.empty(); }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }
  auto data() { return values_.data(); }
  auto data() const { return values_.data(); }

private:
  std::vector<Value> values_;
};

}   // namespace cablenet

template <class Space>
struct std::hash<cablenet::Index<Space>> {
  std::size_t operator()(cablenet::Index<Space> index) const { return std::hash<int>()(index.value()); }
};

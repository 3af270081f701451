#pragma once
#include <initializer_list>
#include <optional>
#include <type_traits>
#include <utility>

#include "kinds.hpp"

/// A table of keys: one row says all about a key, and a section is read by its rows.
/// To add a key, add a row to its section's table and a field for the row to fill.  Then give it a value in a scene of
/// tests/cases/valid/, add the field to tests/support/scene_text.hpp and print src/scene/README.md anew.
/// Tests: tests/unit/keys_test.cpp
namespace cablenet::scene {

/// What an absent key means.
struct Absence {
  enum class Meaning { refused, standard, words } meaning;
  std::string words = {};
};
/// The key must be there.
inline const Absence required{Absence::Meaning::refused};
/// The target keeps the value that it has in a new T.
inline const Absence standard{Absence::Meaning::standard};
/// The key may be absent, and this is what that means.
inline Absence absent(const std::string& words) { return {Absence::Meaning::words, words}; }

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

/// A key whose value goes into a T.
template <class T>
struct Row {
  /// @param target  a pointer to a member of T, or what can be called with (T&, V)
  template <class V, class Target>
  Row(const char* name, const Kind<V>& kind, const Absence& absence, const char* sentence, Target target)
      : key{name, kind.form, absence.meaning == Absence::Meaning::refused, "", absence.words, sentence} {
    read = [from_file = kind.read, target](const Value& value, T& thing) { put(thing, target, from_file(value)); };
    if constexpr (std::is_member_object_pointer_v<Target>)
      if constexpr (!IsOptional<std::remove_cvref_t<decltype(T{}.*target)>>::value)
        if (absence.meaning == Absence::Meaning::standard) key.standard = kind.written(T{}.*target);
  }

  /// Marks a key that only water gives a meaning.
  Row in_fluid() && { return needing("environment.fluid"); }
  /// Marks a key that only the bed gives a meaning.
  Row on_bed() && { return needing("environment.seabed"); }
  /// Marks a key that either of the two gives a meaning.
  Row in_fluid_or_on_bed() && { return needing("environment.fluid or environment.seabed"); }

  Key key;
  std::function<void(const Value&, T&)> read;

private:
  Row needing(const char* section) {
    key.needs = section;
    return std::move(*this);
  }
  template <class Target, class V>
  static void put(T& thing, const Target& target, V value) {
    if constexpr (!std::is_member_object_pointer_v<Target>)
      target(thing, std::move(value));
    else if constexpr (IsOptional<std::remove_cvref_t<decltype(thing.*target)>>::value)
      (thing.*target).emplace(std::move(value));
    else
      thing.*target = std::move(value);
  }
};

enum class Holds { any_keys, one_key };

/// The rows of one kind of section, which is read into a T.
template <class T>
struct Table : KeyTable {
  /// @param looks  what the section looks like, for messages; empty: its keys
  Table(const std::string& says, std::initializer_list<Row<T>> its_rows, Holds holds = Holds::any_keys,
        const std::string& looks = "")
      : KeyTable{says, looks, {}, holds == Holds::one_key}, rows(its_rows) {
    for (const Row<T>& row : rows) keys.push_back(row.key);
    if (expected.empty()) expected = "a map of keys: " + joined_names(keys);
  }

  std::vector<Row<T>> rows;
};

/// Reads the section `map` into `thing`, row by row.
/// @throws InputError at the first key that is unknown, missing, of another form or out of range.
template <class T>
Section read_rows(const Value& map, const Table<T>& table, T& thing) {
  Section section(map, table);
  for (const Row<T>& row : table.rows) {
    if (row.key.is_required) section.require(row.key.name);
    if (const Value* value = section.find(row.key.name)) row.read(*value, thing);
  }
  return section;
}

/// A section that needs nothing but its rows to be read.
template <class T>
Kind<T> section(const Table<T>& table) {
  const auto read = [&table](const Value& map) {
    T thing;
    read_rows(map, table, thing);
    return thing;
  };
  return {section_form(table), read, nullptr};
}

}   // namespace cablenet::scene

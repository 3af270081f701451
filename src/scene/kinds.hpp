#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "cablenet/scene/choice.hpp"
#include "cablenet/scene/keys.hpp"
#include "yaml_reader.hpp"

/// The kinds of values that keys may have.  A kind says what a value looks like in the file and reads one.
/// Tests: tests/unit/keys_test.cpp
namespace cablenet::scene {

/// A kind of value that becomes a V in the program.
template <class V>
struct Kind {
  Form form;
  std::function<V(const Value&)> read;
  std::function<std::string(const V&)> written;   ///< writes a value as a file has it; none where no row needs it
};

inline constexpr Range any_number{};
constexpr Range above(double low) { return {.low = low, .is_low_open = true}; }
constexpr Range at_least(double low) { return {.low = low}; }
constexpr Range between(double low, double high) { return {.low = low, .high = high}; }

Kind<double> number(const std::string& unit, const Range& = any_number);
/// In degrees in the file, in radians in the program.
Kind<double> angle();
Kind<int> integer(int lowest);
Kind<bool> boolean();
/// @param expected  for messages: "the name of a cable type"
Kind<std::string> text(const std::string& expected);
/// [x, y, z].
Kind<Vector3> vector(const std::string& unit);
/// Two integers.  @param labels  "[nx, ny]"
Kind<std::array<int, 2>> integer_pair(const std::string& labels, int lowest);
/// Three numbers >= 0 along the body's axes and three about them.
Kind<std::array<double, 6>> six_numbers(const std::string& along, const std::string& about);

/// The form of a list of numbers.  @param labels  "[t, x, y, z], four numbers [s, m, m, m]"
Form tuple_form(const std::string& labels, const std::vector<NumberForm>& items);
/// The form of a list.  @param expected  "a list of at least 2 rows [x, y, z] [m]"
Form list_form(const std::string& expected, const Form& item, std::size_t least = 0);
/// The form of a map from names.  @param expected  "a map from names to points"
Form map_form(const std::string& expected, const Form& item);
Form section_form(const KeyTable&);
Form word_form(const std::vector<std::string>& words);
Form either_form(const std::string& expected, const std::vector<Form>& forms);

/// "a, b, c".
std::string joined_names(const std::vector<Key>&);

/// A value of this form that is kept as it is.  It is read when the values that it depends on are known.
inline Kind<Value> later(const Form& form) {
  return {form, [](const Value& value) { return value; }, nullptr};
}

/// One word of the enumeration E.
template <class E>
Kind<E> choice() {
  std::vector<std::string> words;
  for (const Choice<E>& one : choices<E>) words.emplace_back(one.name);
  const auto read = [words](const Value& value) { return choices<E>[read_choice(value, words)].value; };
  return {word_form(words), read, [](const E& value) { return std::string(name_of(value)); }};
}

}   // namespace cablenet::scene

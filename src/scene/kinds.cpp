#include "kinds.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace cablenet::scene {

namespace {

constexpr double degree = std::numbers::pi / 180;

std::string written_vector(const Vector3& v) { return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]); }

std::string written_six(const std::array<double, 6>& numbers) { return fmt::format("[{}]", fmt::join(numbers, ", ")); }

std::string expected_of(const NumberForm& form) {
  return form.is_whole ? fmt::format("an integer{}", form.range.text()) : number_expected(form.unit, form.range);
}

}   // namespace

Kind<double> number(const std::string& unit, const Range& range) {
  return {{number_expected(unit, range), NumberForm{unit, range}},
          [unit, range](const Value& value) { return read_number(value, unit, range); },
          [](const double& number) { return fmt::format("{}", number); }};
}

Kind<double> angle() {
  return {number("deg").form, [](const Value& value) { return read_number(value, "deg", any_number) * degree; },
          [](const double& number) { return fmt::format("{}", number / degree); }};
}

Kind<int> integer(int lowest) {
  const NumberForm form{"", at_least(lowest), true};
  return {{expected_of(form), form},
          [lowest](const Value& value) { return read_integer(value, lowest); },
          [](const int& number) { return fmt::format("{}", number); }};
}

Kind<bool> boolean() {
  return {{"true or false", BooleanForm{}}, read_boolean, [](const bool& truth) { return truth ? "true" : "false"; }};
}

Kind<std::string> text(const std::string& expected) {
  return {{expected, TextForm{}},
          [expected](const Value& value) { return read_text(value, expected); },
          [](const std::string& text) { return fmt::format("\"{}\"", text); }};
}

Kind<Vector3> vector(const std::string& unit) {
  const NumberForm component{unit, any_number};
  return {tuple_form(fmt::format("[x, y, z], three numbers [{}]", unit), {component, component, component}),
          [unit](const Value& value) { return read_vector(value, unit); }, written_vector};
}

Kind<std::array<int, 2>> integer_pair(const std::string& labels, int lowest) {
  const std::string expected = fmt::format("{}, two integers >= {}", labels, lowest);
  const NumberForm item{"", at_least(lowest), true};
  const auto read = [expected, lowest](const Value& value) {
    const std::vector<Value> items = read_list(value, expected);
    if (items.size() != 2) value.refuse(expected, "Write exactly 2.");
    return std::array{read_integer(items[0], lowest), read_integer(items[1], lowest)};
  };
  return {tuple_form(expected, {item, item}), read, nullptr};
}

Kind<std::array<double, 6>> six_numbers(const std::string& along, const std::string& about) {
  const std::string expected =
      fmt::format("six numbers >= 0: three along the body's axes [{}], three about them [{}]", along, about);
  const NumberForm one{along, at_least(0)}, other{about, at_least(0)};
  const auto read = [=](const Value& value) {
    read_numbers(value, 6, expected);
    std::array<double, 6> numbers{};
    const std::vector<Value> items = read_list(value, expected);
    for (std::size_t i = 0; i < 6; ++i) numbers[i] = read_number(items[i], i < 3 ? along : about, at_least(0));
    return numbers;
  };
  return {tuple_form(expected, {one, one, one, other, other, other}), read, written_six};
}

Form tuple_form(const std::string& labels, const std::vector<NumberForm>& items) {
  TupleForm row;
  for (const NumberForm& item : items) row.items.push_back({expected_of(item), item});
  return {labels, row};
}

Form list_form(const std::string& expected, const Form& item, std::size_t least) {
  return {expected, ListForm{{item}, least}};
}

Form map_form(const std::string& expected, const Form& item) { return {expected, MapForm{{item}}}; }

Form section_form(const KeyTable& table) { return {table.expected, SectionForm{&table}}; }

Form word_form(const std::vector<std::string>& words) {
  return {fmt::format("{}{}", words.size() > 1 ? "one of: " : "", fmt::join(words, ", ")), ChoiceForm{words}};
}

Form either_form(const std::string& expected, const std::vector<Form>& forms) { return {expected, EitherForm{forms}}; }

std::string joined_names(const std::vector<Key>& keys) {
  std::vector<std::string> names;
  for (const Key& key : keys) names.push_back(key.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

}   // namespace cablenet::scene

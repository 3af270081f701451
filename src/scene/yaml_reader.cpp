#include "yaml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <unordered_set>

#include "cablenet/base/errors.hpp"
#include "spelling.hpp"

namespace cablenet::scene {

namespace {

constexpr std::size_t longest_shown = 60;
constexpr std::size_t longest_path = 200;

/// yaml-cpp marks an empty value at the next token and a map at its first key, so those go by their key.
Value child(const Value& parent, const YAML::Node& node, const std::string& path, int key_line) {
  const bool stands_alone = node.IsScalar();
  return {node, path, stands_alone ? node.Mark().line + 1 : key_line, parent.file};
}

Named entry(const Value& map, const YAML::Node& key, const YAML::Node& node) {
  Value at_key = map;
  at_key.line = key.Mark().line + 1;
  if (!key.IsScalar()) at_key.fail("a key of this map is no name; expected name: value. Write the key as one word.");
  const std::string& name = key.Scalar();
  return {name, child(map, node, map.path.empty() ? name : map.path + "." + name, at_key.line)};
}

std::vector<Named> entries(const Value& map, const std::string& expected) {
  if (!map.node.IsMap()) map.refuse(expected, "Write its keys below it, indented, each as key: value.");
  std::vector<Named> result;
  std::unordered_set<std::string> seen;
  for (const auto& pair : map.node) {
    Named next = entry(map, pair.first, pair.second);
    if (!seen.insert(next.name).second) {
      next.value.line = pair.first.Mark().line + 1;
      next.value.fail("is given twice; expected each key once. Remove or rename one of the two.");
    }
    result.push_back(std::move(next));
  }
  return result;
}

bool is_plain_scalar(const Value& value) { return value.node.IsScalar() && value.node.Tag() != "!"; }

/// The whole text as a number, whatever the locale; nothing if it is none or does not fit.
template <class T>
std::optional<T> parsed(const std::string& text) {
  const char* first = text.data();
  const char* last = first + text.size();
  if (text.size() > 1 && *first == '+' && text[1] != '-') ++first;
  T number{};
  const auto result = std::from_chars(first, last, number);
  if (result.ec != std::errc() || result.ptr != last) return std::nullopt;
  return number;
}

/// What to write instead of a text that is no finite number.
std::string number_advice(const std::string& text) {
  const bool is_yaml_special = text.find(".nan") != std::string::npos || text.find(".inf") != std::string::npos;
  double ignored = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), ignored);
  const bool is_whole = result.ec != std::errc::invalid_argument && result.ptr == text.data() + text.size();
  return is_yaml_special || is_whole ? "Write a finite number, within 1e-307..1e308 in size."
                                     : "Write a number without unit, like 2.5 or 1.0e-3.";
}

/// The sentence as the second half of another.
std::string in_a_sentence(std::string sentence) {
  sentence[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(sentence[0])));
  return sentence;
}

void check_name(const Named& named) {
  const std::string& name = named.name;
  if (name.empty()) named.value.fail("an empty name is not allowed; expected a word. Give it a name.");
  const bool is_clean = std::none_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) <= ' ' || c == '[' || c == ']' || c == '.' || c == ',' || c == '"';
  });
  if (is_clean) return;
  named.value.fail(
      fmt::format("the name \"{}\" is not allowed; expected one without [ ] . , \" and white space. "
                  "Rename it, for instance with _ instead.",
                  name.substr(0, longest_shown)));
}

YAML::Node read_document(const std::string& text, const std::string& file) {
  Value where{YAML::Node(), "", 1, &file};
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.empty()) return YAML::Node();
    if (documents.size() == 1) return documents[0];
    where.line = documents[1].Mark().line + 1;
  } catch (const YAML::Exception& error) {
    where.line = std::max(error.mark.line, 0) + 1;
    where.fail(
        fmt::format("the file is no valid YAML: {}. Look at this line and the one before it: indentation "
                    "(spaces, no tabs), brackets, quotes (names like \"branch[2]\" need them), the space after "
                    "a colon.",
                    error.msg));
  }
  where.fail("a second YAML document begins here; expected one scene per file. Remove the --- or split the file.");
}

}   // namespace

std::string Value::where() const { return fmt::format("{}:{}", *file, line); }

std::string Value::shown() const {
  if (node.IsMap()) return "a map";
  if (node.IsSequence()) return fmt::format("a list of {}", node.size());
  if (!node.IsScalar()) return "nothing";
  std::string text = node.Scalar().substr(0, longest_shown);
  if (text.size() < node.Scalar().size()) text += "...";
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return node.Tag() == "!" ? "the text \"" + text + "\"" : text;
}

std::string Value::said(const std::string& message) const {
  const std::string key = path.size() > longest_path ? path.substr(0, longest_path) + "..." : path;
  std::string text = fmt::format("{}: {}{}{}", where(), key, key.empty() ? "" : ": ", message);
  // A name or a value of the file may hold line ends; a message is one line.
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return text;
}

void Value::fail(const std::string& message) const { throw InputError(said(message)); }

void Value::refuse(const std::string& expected, const std::string& advice) const {
  fail(fmt::format("{} is not allowed; expected {}.{}{}", shown(), expected, advice.empty() ? "" : " ", advice));
}

Section::Section(const Value& map, const KeyTable& table)
    : map_(map), table_(table), entries_(entries(map, table.expected)) {
  std::vector<std::string> names;
  for (const Key& key : table.keys) names.push_back(key.name);
  for (const Named& named : entries_)
    if (std::find(names.begin(), names.end(), named.name) == names.end())
      named.value.fail(fmt::format("unknown key; expected one of: {}.{} Correct or remove it.", fmt::join(names, ", "),
                                   did_you_mean(named.name, names)));
  if (table.takes_one && entries_.size() != 1) map.refuse(table.expected + ", exactly one of them", "Keep one.");
}

const Value* Section::find(const std::string& key) const {
  for (const Named& named : entries_)
    if (named.name == key) return &named.value;
  return nullptr;
}

const Value& Section::require(const std::string& key, const std::string& why) const {
  if (const Value* value = find(key)) return *value;
  const auto row =
      std::find_if(table_.keys.begin(), table_.keys.end(), [&](const Key& candidate) { return candidate.name == key; });
  Value missing = map_;
  missing.path += fmt::format("{}{}", missing.path.empty() ? "" : ".", key);
  missing.fail(
      fmt::format("is missing; expected {}{}. Add it: {}", row->form.expected, why, in_a_sentence(row->sentence)));
}

std::string number_expected(const std::string& unit, const Range& range) {
  return fmt::format("a number{}{}", range.text(), unit.empty() ? "" : fmt::format(" [{}]", unit));
}

double read_number(const Value& value, const std::string& unit, const Range& range) {
  const auto refuse = [&](const std::string& advice) { value.refuse(number_expected(unit, range), advice); };
  if (value.node.IsScalar() && !is_plain_scalar(value)) refuse("Write it without quotes.");
  if (!value.node.IsScalar()) refuse("Write one number, like 2.5 or 1.0e-3.");
  const auto number = parsed<double>(value.node.Scalar());
  if (!number || !std::isfinite(*number)) refuse(number_advice(value.node.Scalar()));
  if (!range.contains(*number)) refuse("Correct the value.");
  return *number;
}

int read_integer(const Value& value, int lowest) {
  const auto number = is_plain_scalar(value) ? parsed<int>(value.node.Scalar()) : std::nullopt;
  if (number && *number >= lowest) return *number;
  const bool is_huge = is_plain_scalar(value) && parsed<long long>(value.node.Scalar()).value_or(0) > lowest;
  const std::string range = is_huge ? fmt::format("{}..2147483647", lowest) : fmt::format(">= {}", lowest);
  value.refuse("an integer " + range, "Write a whole number in digits only.");
}

bool read_boolean(const Value& value) {
  if (is_plain_scalar(value) && value.node.Scalar() == "true") return true;
  if (is_plain_scalar(value) && value.node.Scalar() == "false") return false;
  value.refuse("true or false", "Write one of the two.");
}

std::string read_text(const Value& value, const std::string& expected) {
  if (!value.node.IsScalar()) value.refuse(expected, "Write one text.");
  return value.node.Scalar();
}

std::size_t read_choice(const Value& value, const std::vector<std::string>& choices) {
  const std::string expected = fmt::format("one of: {}", fmt::join(choices, ", "));
  const std::string text = read_text(value, expected);
  const auto found = std::find(choices.begin(), choices.end(), text);
  if (found == choices.end()) value.refuse(expected, "Write one of these." + did_you_mean(text, choices));
  return static_cast<std::size_t>(found - choices.begin());
}

std::vector<Value> read_list(const Value& value, const std::string& expected) {
  if (!value.node.IsSequence()) value.refuse(expected, "Write a list in brackets: [a, b, c].");
  std::vector<Value> items;
  items.reserve(value.node.size());
  for (const auto& node : value.node) {
    const int line = node.IsNull() ? value.line : node.Mark().line + 1;
    items.push_back({node, fmt::format("{}[{}]", value.path, items.size()), line, value.file});
  }
  return items;
}

std::vector<double> read_numbers(const Value& value, std::size_t count, const std::string& expected) {
  const std::vector<Value> items = read_list(value, expected);
  if (items.size() != count) value.refuse(expected, fmt::format("Write exactly {} numbers.", count));
  std::vector<double> numbers;
  numbers.reserve(count);
  for (const Value& item : items) numbers.push_back(read_number(item, "", {}));
  return numbers;
}

Vector3 read_vector(const Value& value, const std::string& unit) {
  const std::vector<double> numbers = read_numbers(value, 3, fmt::format("[x, y, z], three numbers [{}]", unit));
  return {numbers[0], numbers[1], numbers[2]};
}

std::vector<Vector3> read_vectors(const Value& value, std::size_t least, const std::string& unit) {
  const std::string number = least > 0 ? fmt::format("at least {} ", least) : "";
  const std::string expected = fmt::format("a list of {}rows [x, y, z] [{}]", number, unit);
  const std::vector<Value> rows = read_list(value, expected);
  if (rows.size() < least) value.refuse(expected, "Add rows.");
  std::vector<Vector3> vectors;
  vectors.reserve(rows.size());
  for (const Value& row : rows) vectors.push_back(read_vector(row, unit));
  return vectors;
}

std::vector<Named> read_named(const Value& value, const std::string& expected) {
  std::vector<Named> result = entries(value, expected);
  for (const Named& named : result) check_name(named);
  return result;
}

Value parse_yaml(const std::string& text, const std::string& file) {
  Value top{read_document(text, file), "", 1, &file};
  if (top.node.IsScalar() || top.node.IsSequence()) top.line = top.node.Mark().line + 1;
  if (!top.node.IsMap())
    top.refuse("a scene: a map with cable_types, points, cables, nets or bodies, and time",
               "Write these keys at the top level.");
  return top;
}

}   // namespace cablenet::scene

#pragma once
#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "cablenet/base/linear_algebra.hpp"
#include "cablenet/scene/keys.hpp"

/// Reads single values of a YAML file.  Every refusal names the file and line, the key's path, the value, what is
/// allowed there and what to do.  Tests: tests/unit/read_test.cpp, tests/cases/broken/
namespace cablenet::scene {

/// A value of the file and where it stands.
struct Value {
  const YAML::Node node;               ///< const, as assigning to a YAML::Node would change the tree
  std::string path;                    ///< as in cable_types.steel.area
  int line = 1;                        ///< of the value, or of its key where the value is a list, a map or nothing
  const std::string* file = nullptr;   ///< outlives the value

  std::string where() const;                            ///< "file:line"
  std::string shown() const;                            ///< as messages cite it
  std::string said(const std::string& message) const;   ///< "file:line: path: message", one line
  /// @throws InputError with what is said, always.
  [[noreturn]] void fail(const std::string& message) const;
  /// @throws InputError "file:line: path: VALUE is not allowed; expected EXPECTED. ADVICE", always.
  [[noreturn]] void refuse(const std::string& expected, const std::string& advice = "") const;
};

struct Named {
  std::string name;
  Value value;
};

/// A map with a fixed set of keys.
class Section {
public:
  /// @throws InputError if `map` is no map, a key is unknown or doubled, or not exactly one is there where one must be.
  Section(const Value& map, const KeyTable&);

  const Value* find(const std::string& key) const;   ///< nullptr if absent
  /// @throws InputError if absent, saying what was expected and `why` it is needed.
  const Value& require(const std::string& key, const std::string& why = "") const;
  const Value& map() const { return map_; }

private:
  Value map_;
  const KeyTable& table_;
  std::vector<Named> entries_;
};

/// "a number > 0 [m]".
std::string number_expected(const std::string& unit, const Range&);

/// @param unit  for messages: "m"; empty for a pure number
double read_number(const Value&, const std::string& unit, const Range&);
int read_integer(const Value&, int lowest);
bool read_boolean(const Value&);
std::string read_text(const Value&, const std::string& expected);
/// The index of the value in `choices`.
std::size_t read_choice(const Value&, const std::vector<std::string>& choices);
std::vector<Value> read_list(const Value&, const std::string& expected);
/// A list of exactly `count` finite numbers.
std::vector<double> read_numbers(const Value&, std::size_t count, const std::string& expected);
Vector3 read_vector(const Value&, const std::string& unit);
/// A list of at least `least` triples.
std::vector<Vector3> read_vectors(const Value&, std::size_t least, const std::string& unit);
/// A map from names of the user's choice, in file order.
std::vector<Named> read_named(const Value&, const std::string& expected);

/// The top of the file.
/// @throws InputError if `text` is no YAML, or more than one document.
Value parse_yaml(const std::string& text, const std::string& file);

}   // namespace cablenet::scene

#pragma once
#include <limits>
#include <string>
#include <variant>
#include <vector>

/// The keys of a scene file as data.  Each key is one row in src/scene/; the reader, its messages, the JSON Schema and
/// the reference are made from these rows.  Tests: tests/unit/keys_test.cpp
namespace cablenet::scene {

/// The numbers from `low` to `high`.  An end that is open does not belong to the range.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool is_low_open = false;
  bool is_high_open = false;

  bool contains(double number) const;
  std::string text() const;   ///< " > 0", " >= 0", " in 0..1"; empty where every number belongs to it
};

struct Form;
struct KeyTable;

struct NumberForm {
  std::string unit;   ///< as in the file, "deg" for angles; empty: a pure number
  Range range;
  bool is_whole = false;
};
struct BooleanForm {};
/// A text that the user chooses: a title, a name of something, an expression.
struct TextForm {};
/// One word of several.
struct ChoiceForm {
  std::vector<std::string> names;
};
/// A list whose items are alike.
struct ListForm {
  std::vector<Form> item;   ///< exactly one
  std::size_t least = 0;
};
/// A list with a form of its own for each item, such as [t, x, y, z].
struct TupleForm {
  std::vector<Form> items;
};
/// A map from names of the user's choice to values that are alike.
struct MapForm {
  std::vector<Form> item;   ///< exactly one
};
/// A map with a fixed set of keys.
struct SectionForm {
  const KeyTable* table;
};
/// A value in one of several forms.
struct EitherForm {
  std::vector<Form> forms;
};

/// What a value may look like in the file.
struct Form {
  std::string expected;   ///< for messages and the reference: "a number > 0 [m]"
  std::variant<NumberForm, BooleanForm, TextForm, ChoiceForm, ListForm, TupleForm, MapForm, SectionForm, EitherForm>
      details;
};

struct Key {
  std::string name;
  Form form;
  bool is_required = false;
  std::string standard;   ///< what an absent key stands for, as it would be written; empty: see `absent`
  std::string absent;     ///< what an absent key means, in words
  std::string sentence;
  std::string needs = {};   ///< the section without which the key does nothing; empty: none
};

/// The keys of one kind of section.
struct KeyTable {
  std::string sentence;   ///< what the section describes
  std::string expected;   ///< for messages: what a section looks like
  std::vector<Key> keys;
  bool takes_one = false;   ///< a section holds exactly one of the keys
};

/// The keys at the top of a scene file; all others are reached through their forms.
const KeyTable& scene_keys();

}   // namespace cablenet::scene

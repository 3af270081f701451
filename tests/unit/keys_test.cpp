#include "cablenet/scene/keys.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "../support/scene_keys.hpp"
#include "../support/scene_text.hpp"
#include "cablenet/base/errors.hpp"
#include "cablenet/scene/read.hpp"
#include "cablenet/scene/schema.hpp"

/// What each row of the key tables promises, tried on two scenes that have every key.
namespace cablenet::scene {
namespace {

using test::Known;
using test::Path;
using test::Spot;
using test::operator/;

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(std::string(CABLENET_ROOT) + "/" + path).rdbuf();
  return text.str();
}

const std::vector<Known>& keys() {
  static const test::KnownKeys known(scene_keys(), {YAML::Load(text_of("tests/cases/valid/everything.yaml")),
                                                    YAML::Load(text_of("tests/cases/valid/alternatives.yaml"))});
  return known.all();
}

/// What became of a scene file: the scene's text or the reason why it was refused.
struct Outcome {
  std::string scene, refusal;
};
Outcome outcome(const YAML::Node& changed) {
  try {
    return {test::SceneText(read_scene(YAML::Dump(changed), "keys.yaml")).text(), ""};
  } catch (const InputError& error) {
    return {"", error.what()};
  }
}

/// The message about the value at `path` names it and where it stands.
void expect_refused(const YAML::Node& changed, const Path& path, const std::string& expected) {
  const std::string refusal = outcome(changed).refusal;
  const YAML::Node value = test::at(YAML::Load(YAML::Dump(changed)), path);
  if (value.IsDefined() && value.IsScalar()) {
    const std::string where = "keys.yaml:" + std::to_string(value.Mark().line + 1) + ": ";
    EXPECT_EQ(refusal.substr(0, where.size()), where) << refusal;
  }
  EXPECT_NE(refusal.find(": " + test::written(path) + ": "), std::string::npos) << test::written(path) << refusal;
  EXPECT_NE(refusal.find(expected), std::string::npos) << test::written(path) << ": " << expected << refusal;
}

/// The form of a value among several: the first that its kind of node fits.
const Form& fitting(const Form& form, const YAML::Node& node) {
  const auto* either = std::get_if<EitherForm>(&form.details);
  if (either == nullptr) return form;
  for (const Form& one : either->forms) {
    const bool is_map = std::holds_alternative<SectionForm>(one.details);
    const auto* row = std::get_if<TupleForm>(&one.details);
    const bool is_list = std::holds_alternative<ListForm>(one.details) || row != nullptr;
    const bool has_size = row == nullptr || row->items.size() == node.size();
    if (is_map == node.IsMap() && is_list == node.IsSequence() && has_size) return one;
  }
  return form;
}

struct Leaf {
  Path path;
  NumberForm form;
  std::string expected;
};

/// The numbers in a value.
void find_numbers(const Form& given, const YAML::Node& node, const Path& path, std::vector<Leaf>& leaves) {
  const Form& form = fitting(given, node);
  if (const auto* number = std::get_if<NumberForm>(&form.details)) leaves.push_back({path, *number, form.expected});
  const auto* row = std::get_if<TupleForm>(&form.details);
  const auto* list = std::get_if<ListForm>(&form.details);
  for (std::size_t i = 0; (row != nullptr || list != nullptr) && i < node.size(); ++i)
    find_numbers(row != nullptr ? row->items[i] : list->item[0], node[i], path / test::place_in_list(i), leaves);
}

std::vector<Leaf> numbers(const Known& known, const Spot& spot) {
  std::vector<Leaf> leaves;
  find_numbers(known.key->form, test::at(spot), spot.path, leaves);
  return leaves;
}

std::string number_text(double number) {
  std::ostringstream text;
  text.precision(17);
  text << number;
  return text.str();
}

/// The file with `leaves` a little larger or smaller.
YAML::Node moved(const Spot& spot, const std::vector<Leaf>& leaves, double by) {
  YAML::Node file = YAML::Clone(spot.file);
  for (const Leaf& leaf : leaves) {
    const double number = test::at(file, leaf.path).as<double>();
    const double other = leaf.form.is_whole || number == 0 ? number + std::copysign(1, by) : number * (1 + by);
    file = test::with(file, leaf.path, YAML::Node(number_text(other)));
  }
  return file;
}

/// Files in which the key has another value at the spot.
std::vector<YAML::Node> others(const Known& known, const Spot& spot) {
  const YAML::Node node = test::at(spot);
  const Form& form = fitting(known.key->form, node);
  std::vector<YAML::Node> files;
  const std::vector<Leaf> all = numbers(known, spot);
  for (const double by : {0.01, -0.01}) {
    files.push_back(moved(spot, all, by));
    if (all.size() > 1) files.push_back(moved(spot, {all.back()}, by));
  }
  if (all.empty()) files.clear();
  if (std::holds_alternative<BooleanForm>(form.details))
    files.push_back(test::with(spot, YAML::Node(node.as<bool>() ? "false" : "true")));
  if (std::holds_alternative<TextForm>(form.details))
    files.push_back(test::with(spot, YAML::Node(node.as<std::string>() + "+1")));
  if (const auto* choice = std::get_if<ChoiceForm>(&form.details))
    for (const std::string& name : choice->names) files.push_back(test::with(spot, YAML::Node(name)));
  if (node.IsSequence()) {
    YAML::Node shorter = YAML::Clone(node);
    shorter.remove(node.size() - 1);
    files.push_back(test::with(spot, shorter));
  }
  for (const Spot& sibling : known.spots) files.push_back(test::with(spot, test::at(sibling)));
  return files;
}

bool changes_the_scene(const Known& known) {
  const bool is_whole_map = std::holds_alternative<SectionForm>(known.key->form.details) ||
                            std::holds_alternative<MapForm>(known.key->form.details);
  for (const Spot& spot : known.spots) {
    const std::string scene = outcome(spot.file).scene;
    // The keys of a map are tried one by one; here it counts that the map as a whole does something.
    if (is_whole_map && outcome(test::without(spot)).scene != scene) return true;
    for (const YAML::Node& file : others(known, spot)) {
      const Outcome changed = outcome(file);
      if (changed.refusal.empty() && changed.scene != scene) return true;
    }
  }
  return false;
}

TEST(Keys, EveryKeyIsDocumented) {
  const std::set<std::string> pure = {"accuracy",
                                      "environment.seabed.friction",
                                      "cable_types.*.normal_drag",
                                      "cable_types.*.tangential_drag",
                                      "cable_types.*.added_mass",
                                      "nets.*.slack",
                                      "time.spectral_radius"};
  ASSERT_GT(keys().size(), 80u);
  for (const Known& known : keys()) {
    const Key& key = *known.key;
    EXPECT_GT(key.sentence.size(), 3u) << known.name;
    EXPECT_TRUE(std::isupper(static_cast<unsigned char>(key.sentence.front()))) << known.name;
    EXPECT_EQ(key.sentence.back(), '.') << known.name;
    EXPECT_FALSE(key.form.expected.empty()) << known.name;
    const bool is_said = key.is_required || known.table->takes_one || !key.standard.empty() || !key.absent.empty();
    EXPECT_TRUE(is_said) << known.name << ": what does its absence mean?";
    const auto* number = std::get_if<NumberForm>(&key.form.details);
    if (number != nullptr && !number->is_whole) {
      EXPECT_EQ(number->unit.empty(), pure.count(known.name) > 0) << known.name << ": [" << number->unit << "]";
    }
  }
}

TEST(Keys, EveryKeyStandsInAScene) {
  for (const Known& known : keys())
    EXPECT_FALSE(known.spots.empty()) << known.name << ": add it to a scene in tests/cases/valid/";
  for (const Known& known : keys())
    for (const Spot& spot : known.spots) ASSERT_EQ(outcome(spot.file).refusal, "");
}

TEST(Keys, EveryKeyIsRead) {
  for (const Known& known : keys())
    EXPECT_TRUE(changes_the_scene(known))
        << known.name << ": no other value of it changes the scene as tests/support/scene_text.hpp writes it";
}

TEST(Keys, NumbersOutOfRangeAreRefused) {
  int tried = 0;
  for (const Known& known : keys()) {
    for (const Leaf& leaf : numbers(known, known.spots.at(0))) {
      const Range& range = leaf.form.range;
      std::vector<double> outside;
      if (std::isfinite(range.low)) outside.push_back(range.is_low_open ? range.low : range.low - 1);
      if (std::isfinite(range.high)) outside.push_back(range.is_high_open ? range.high : range.high + 1);
      for (const double number : outside) {
        const std::string given = number_text(number);
        expect_refused(test::with(known.spots[0].file, leaf.path, YAML::Node(given)), leaf.path,
                       given + " is not allowed; expected " + leaf.expected);
        ++tried;
      }
    }
  }
  EXPECT_GT(tried, 60);
}

TEST(Keys, NumbersAreFiniteAndNoWords) {
  for (const Known& known : keys()) {
    const std::vector<Leaf> leaves = numbers(known, known.spots.at(0));
    if (leaves.empty()) continue;
    for (const char* wrong : {".nan", ".inf", "wide", "2 m"})
      expect_refused(test::with(known.spots[0].file, leaves.back().path, YAML::Node(wrong)), leaves.back().path,
                     std::string(wrong) + " is not allowed; expected ");
  }
}

TEST(Keys, ValuesOfAnotherFormAreRefused) {
  for (const Known& known : keys()) {
    const Spot& spot = known.spots.at(0);
    const auto& details = known.key->form.details;
    const bool is_end = known.name == "cables.*.from" || known.name == "cables.*.to";
    const bool takes_words = std::holds_alternative<TextForm>(details) || is_end;
    const bool takes_lists = std::holds_alternative<ListForm>(details) || known.name == "cables.*.shape";
    if (!takes_words)
      expect_refused(test::with(spot, YAML::Node("nonsense")), spot.path, "nonsense is not allowed; expected ");
    if (!takes_lists)
      expect_refused(test::with(spot, YAML::Load("[1]")), spot.path, "a list of 1 is not allowed; expected ");
  }
}

TEST(Keys, AnAbsentKeyStandsForItsStandard) {
  for (const Known& known : keys()) {
    if (known.key->standard.empty()) continue;
    bool is_tried = false;
    for (const Spot& spot : known.spots) {
      const Outcome absent = outcome(test::without(spot));
      const Outcome given = outcome(test::with(spot, YAML::Load(known.key->standard)));
      EXPECT_EQ(absent.scene, given.scene) << test::written(spot.path);
      is_tried = is_tried || absent.refusal.empty();
    }
    EXPECT_TRUE(is_tried) << known.name;
  }
}

TEST(Keys, RequiredKeysAreMissed) {
  for (const Known& known : keys())
    if (known.key->is_required)
      expect_refused(test::without(known.spots.at(0)), known.spots[0].path,
                     "is missing; expected " + known.key->form.expected);
}

TEST(Keys, MisspeltKeysAreRecognised) {
  for (const Known& known : keys()) {
    if (known.key->name.size() < 2) continue;
    const Spot& spot = known.spots.at(0);
    Path misspelt = spot.path;
    misspelt.back() += "_";
    const YAML::Node changed = test::with(test::without(spot), misspelt, test::at(spot));
    expect_refused(changed, misspelt, "unknown key; expected one of: ");
    EXPECT_NE(outcome(changed).refusal.find("Did you mean " + known.key->name + "?"), std::string::npos) << known.name;
  }
}

TEST(Keys, TheReferenceIsWhatTheProgramPrints) {
  EXPECT_EQ(text_of("src/scene/README.md"), key_reference())
      << "to mend: build/cablenet schema --markdown > src/scene/README.md";
}

TEST(Range, HoldsItsClosedEndsOnly) {
  const Range closed{.low = 0, .high = 1};
  const Range open{.low = 0, .high = 1, .is_low_open = true, .is_high_open = true};
  EXPECT_TRUE(closed.contains(0) && closed.contains(1));
  EXPECT_FALSE(closed.contains(-1e-300) || closed.contains(1.0000001));
  EXPECT_FALSE(open.contains(0) || open.contains(1));
  EXPECT_TRUE(open.contains(0.5) && Range{}.contains(-1e300));
  EXPECT_EQ(closed.text(), " in 0..1");
  EXPECT_EQ(open.text(), " > 0 and < 1");
  EXPECT_EQ((Range{.high = 3}.text()), " <= 3");
  EXPECT_EQ(Range{}.text(), "");
}

TEST(Choice, NamesAreThoseOfTheFile) {
  EXPECT_STREQ(name_of(Scheme::plain), "plain");
  EXPECT_STREQ(name_of(Rotation::euler), "euler");
  EXPECT_STREQ(name_of(Edge::left), "left");
  EXPECT_STREQ(name_of(Shape::polyline), "");
}

}   // namespace
}   // namespace cablenet::scene

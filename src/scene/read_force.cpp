#include "laws.hpp"

namespace cablenet::scene {

namespace {

const std::string force_expected = "[x, y, z], three numbers [N], {waypoints: ..} or {expression: ..}";

const Table<ForceKeys>& force_table() {
  static const Table<ForceKeys> table(
      "A force that depends on time.",
      {{"waypoints", timed_rows("N"), absent(""), "Rows of time and force; between them the force changes evenly.",
        &ForceKeys::waypoints},
       {"expression", written_vector(), absent(""), "The force [N], as expressions of t.", &ForceKeys::expression}},
      Holds::one_key, force_expected);
  return table;
}

ForceKeys read_force(const Value& value) {
  ForceKeys keys;
  if (!value.node.IsMap()) {
    if (!value.node.IsSequence()) value.refuse(force_expected, "Choose one of these.");
    keys.constant = read_vector(value, "N");
    return keys;
  }
  const Section section = read_rows(value, force_table(), keys);
  for (const Key& key : force_table().keys)
    if (const Value* law = section.find(key.name)) keys.law.emplace(*law);
  return keys;
}

}   // namespace

Kind<ForceKeys> force() {
  return {either_form(force_expected, {vector("N").form, section_form(force_table())}), read_force, nullptr};
}

}   // namespace cablenet::scene

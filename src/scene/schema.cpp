#include "cablenet/scene/schema.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cablenet/scene/keys.hpp"

namespace cablenet::scene {

namespace {

using Json = nlohmann::ordered_json;

Json described(const Form&);

Json described(const NumberForm& form) {
  Json json{{"type", form.is_whole ? "integer" : "number"}};
  const Range& range = form.range;
  if (std::isfinite(range.low)) json[range.is_low_open ? "exclusiveMinimum" : "minimum"] = range.low;
  if (std::isfinite(range.high)) json[range.is_high_open ? "exclusiveMaximum" : "maximum"] = range.high;
  return json;
}

Json described(const BooleanForm&) { return {{"type", "boolean"}}; }

/// A name or an expression without quotes may look like a number.
Json described(const TextForm&) { return {{"type", {"string", "number", "boolean"}}}; }

Json described(const ChoiceForm& form) { return {{"enum", form.names}}; }

Json described(const ListForm& form) {
  return {{"type", "array"}, {"items", described(form.item[0])}, {"minItems", form.least}};
}

Json described(const TupleForm& form) {
  Json items = Json::array();
  for (const Form& item : form.items) items.push_back(described(item));
  const std::size_t count = form.items.size();
  return {{"type", "array"}, {"items", items}, {"minItems", count}, {"maxItems", count}};
}

Json described(const MapForm& form) {
  return {{"type", "object"},
          {"propertyNames", {{"pattern", "^[^\\s\\[\\].,\"]+$"}}},
          {"additionalProperties", described(form.item[0])}};
}

std::string description(const Key& key) {
  const std::string absent = key.absent.empty() ? "" : fmt::format(" If absent: {}.", key.absent);
  return fmt::format("{} Expected: {}.{}", key.sentence, key.form.expected, absent);
}

/// A word stands in a scene file without quotes.
Json as_json(const std::string& written) {
  const Json json = Json::parse(written, nullptr, false);
  return json.is_discarded() ? Json(written) : json;
}

Json described(const Key& key) {
  Json json = described(key.form);
  json["description"] = description(key);
  if (!key.standard.empty()) json["default"] = as_json(key.standard);
  if (const auto* number = std::get_if<NumberForm>(&key.form.details); number != nullptr && !number->unit.empty())
    json["x-unit"] = number->unit;
  return json;
}

Json described(const KeyTable& table) {
  Json json{{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
  for (const Key& key : table.keys) {
    json["properties"][key.name] = described(key);
    if (key.is_required) json["required"].push_back(key.name);
  }
  if (table.takes_one) json["minProperties"] = json["maxProperties"] = 1;
  return json;
}

Json described(const SectionForm& form) { return described(*form.table); }

Json described(const EitherForm& form) {
  Json forms = Json::array();
  for (const Form& one : form.forms) forms.push_back(described(one));
  return {{"anyOf", forms}};
}

Json described(const Form& form) {
  return std::visit([](const auto& details) { return described(details); }, form.details);
}

}   // namespace

std::string json_schema() {
  Json json{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "A scene of cablenet"}};
  json.update(described(scene_keys()));
  return json.dump(2) + "\n";
}

}   // namespace cablenet::scene

#include "laws.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cablenet/base/errors.hpp"
#include "expression.hpp"

namespace cablenet::scene {

namespace {

/// When a law is asked for, for messages.
std::string needed_times(const Time& time) {
  if (time.end > time.start) return fmt::format("all of {}..{} s, from time.start to time.end", time.start, time.end);
  return fmt::format("t = {} s, at which a scene without time is solved", time.start);
}

TimedRows read_timed_rows(const Value& value, const Form& form, const std::string& labels) {
  const std::vector<Value> rows = read_list(value, form.expected);
  if (rows.size() < 2) value.refuse(form.expected, "Add rows.");
  TimedRows result;
  for (const Value& row : rows) {
    const std::vector<double> numbers = read_numbers(row, 4, labels);
    if (!result.times.empty() && !(numbers[0] > result.times.back()))
      row.fail(fmt::format("t = {} is not allowed; expected a time > {}, that of the row before. Sort the rows.",
                           numbers[0], result.times.back()));
    result.times.push_back(numbers[0]);
    result.vectors.emplace_back(numbers[1], numbers[2], numbers[3]);
  }
  return result;
}

/// @throws InputError at `value` if it is no expression of t.
std::string read_expression(const Value& value) {
  const std::string text = read_text(value, "an expression of t");
  try {
    const Expression ignored(text);
  } catch (const InputError& error) {
    value.fail(error.what());
  }
  return text;
}

Kind<std::string> expression() { return {text("an expression of t").form, read_expression, nullptr}; }

template <std::size_t i>
void set_component(WrittenVector& vector, const std::string& text) {
  vector.texts[i] = text;
}

const Table<WrittenVector>& written_table() {
  static const Table<WrittenVector> table(
      "A vector whose components are expressions of the time t [s], with + - * / ^, sin, cos, exp and the like.",
      {{"x", expression(), absent("0"), "The x component.", set_component<0>},
       {"y", expression(), absent("0"), "The y component.", set_component<1>},
       {"z", expression(), absent("0"), "The z component.", set_component<2>}});
  return table;
}

/// At how many times of the scene an expression is looked at.  A root or a logarithm may leave its range on the way; so
/// many looks find what a user is likely to write.
constexpr int looks = 1000;

void check_covered(const Value& value, const TimedRows& rows, const Time& time) {
  if (rows.times.front() <= time.start && rows.times.back() >= time.end) return;
  value.fail(fmt::format("the rows cover {}..{} s; expected {}. Add rows or {}.", rows.times.front(), rows.times.back(),
                         needed_times(time), time.end > time.start ? "shorten the time" : "shift their times"));
}

void check_finite(const Value& value, const Motion& law, const Time& time, const std::string& what) {
  for (int i = 0; i <= looks; ++i) {
    const double t = time.start + (time.end - time.start) * i / looks;
    const Kinematics k = law.at(t);
    if (!k.x.allFinite() || !k.v.allFinite() || !k.a.allFinite())
      value.fail(fmt::format("{} is not finite at t = {} s; expected finite ones at {}. Change the expression.", what,
                             t, needed_times(time)));
  }
}

}   // namespace

Kind<TimedRows> timed_rows(const std::string& unit) {
  const std::string units = fmt::format("[s, {}, {}, {}]", unit, unit, unit);
  const std::string labels = "[t, x, y, z], four numbers " + units;
  const NumberForm time{"s", any_number}, component{unit, any_number};
  const Form form = list_form("a list of at least 2 rows [t, x, y, z] " + units,
                              tuple_form(labels, {time, component, component, component}), 2);
  return {form, [=](const Value& value) { return read_timed_rows(value, form, labels); }, nullptr};
}

Kind<WrittenVector> written_vector() { return section(written_table()); }

Motion make_law(const LawKeys& keys, const Vector3& origin, const Time& time, const std::string& what) {
  if (keys.waypoints) {
    check_covered(*keys.law, *keys.waypoints, time);
    return Motion::waypoints(keys.waypoints->times, keys.waypoints->vectors);
  }
  const Motion law = Motion::expression(origin, keys.expression->texts);
  check_finite(*keys.law, law, time, what);
  return law;
}

std::optional<ForceLaw> make_force_law(const ForceKeys& keys, const Time& time) {
  if (!keys.law) return std::nullopt;
  if (keys.waypoints) {
    check_covered(*keys.law, *keys.waypoints, time);
    return ForceLaw::rows(keys.waypoints->times, keys.waypoints->vectors);
  }
  const Motion law = make_law(keys, Vector3::Zero(), time, "force or one of its derivatives");
  double largest = 0;
  for (int i = 0; i <= looks; ++i)
    largest = std::max(largest, law.at(time.start + (time.end - time.start) * i / looks).x.norm());
  return ForceLaw([law](double t) { return law.at(t).x; }, largest);
}

}   // namespace cablenet::scene

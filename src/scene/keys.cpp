#include "cablenet/scene/keys.hpp"

#include <fmt/format.h>

#include <cmath>

namespace cablenet::scene {

bool Range::contains(double number) const {
  return (is_low_open ? number > low : number >= low) && (is_high_open ? number < high : number <= high);
}

std::string Range::text() const {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  if (has_low && has_high && !is_low_open && !is_high_open) return fmt::format(" in {}..{}", low, high);
  std::string text;
  if (has_low) text += fmt::format(" {} {}", is_low_open ? ">" : ">=", low);
  if (has_high) text += fmt::format("{} {} {}", has_low ? " and" : "", is_high_open ? "<" : "<=", high);
  return text;
}

}   // namespace cablenet::scene

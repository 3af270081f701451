#include "tension_record.hpp"

#include <algorithm>
#include <cmath>

#include "cablenet/elements/cable_step.hpp"
#include "node_data.hpp"

namespace cablenet::system {
namespace {

/// A push that is smaller than this part of what the element has pulled is none.
constexpr double part_of_pull = 1e-3;

/// By so much more a later extreme has to be larger to count as such: the same one, come again, differs by rounding,
/// and otherwise on other numbers of ranks.
constexpr double ahead = 1 + 1e-4;

/// However long an implicit step is, it multiplies a growing disturbance by about exp(most_in_step) at most.
constexpr double most_in_step = 2;

void take_push(ElementTension& e, double push, double t, double dt, double L, double mass_per_length) {
  if (push > -ahead * e.least) {
    e.least = -push;
    e.least_at = t;
  }
  e.pushed += dt;
  if (e.last >= -part_of_pull * e.largest) e.folding = 0;
  e.folding += std::min(dt * std::sqrt(12 * push / mass_per_length) / L, most_in_step);
  e.most_folding = std::max(e.most_folding, e.folding);
}

bool is_damped(const elements::CableMaterial& material) { return material.axial_damping > 0; }

}   // namespace

TensionRecord::TensionRecord(const partition::LocalNetwork& network)
    : network_(network),
      is_damped_(std::any_of(network.materials.begin(), network.materials.end(), is_damped)),
      elements_(at(network.own_elements)) {
  for (std::size_t i = 0; i < elements_.size(); ++i)
    springs_.push_back({material(i).axial_stiffness / network.elements[i].length, network.elements[i].length});
}

void TensionRecord::take(std::size_t i, double T, double t, double dt) {
  ElementTension& e = elements_[i];
  // In most steps nothing is new.
  if (T > e.lasting) {
    if (T > ahead * e.largest) {
      e.largest = T;
      e.largest_at = t;
    }
    e.lasting = std::max(e.lasting, std::min(T, e.last));
  } else if (T < -part_of_pull * e.largest && !material(i).tension_only) {
    take_push(e, -T, t, dt, springs_[i].length, material(i).mass_per_length);
  }
  e.last = T;
}

template <class Nodes>
void TensionRecord::take_at(double t, partition::Range range, const Nodes& nodes) {
  for (std::size_t i = at(range.first); i < at(range.last); ++i) {
    const partition::LocalElement& e = network_.elements[i];
    const auto n1 = nodes.key(e, 0), n2 = nodes.key(e, 1);
    const elements::Stretch s = elements::stretch(nodes.x(n2) - nodes.x(n1));
    take(i, elements::instant_tension<true>(material(i), e.length, s, nodes.v(n2) - nodes.v(n1)), t, since(t));
  }
}

void TensionRecord::add(const Evaluation& start, std::span<const elements::ReachedStart> reached) {
  const double t = start.situation.stage.t, dt = since(t);
  const int inner = std::min(network_.inner_elements, network_.own_elements);
  if (reached.empty() || is_damped_) {
    take_at(t, {0, inner}, InnerNodes{start.data});
    take_at(t, {inner, network_.own_elements}, AnyNodes{start.data});
  } else {
    for (std::size_t i = 0; i < elements_.size(); ++i)
      take(i, springs_[i].stiffness * (reached[i].s.l - springs_[i].length), t, dt);
  }
  last_time_ = t;
  has_begun_ = true;
}

std::span<const ElementTension> TensionRecord::until(const LocalState& end) {
  if (!has_begun_ || end.t > last_time_) take_at(end.t, {0, network_.own_elements}, StateNodes{end});
  last_time_ = end.t;
  has_begun_ = true;
  return elements_;
}

void TensionRecord::archive(Archive& archive) {
  archive.item("tensions.begun", has_begun_);
  archive.item("tensions.time", last_time_);
  using E = ElementTension;
  for (E& e : elements_)
    for (double E::*number : {&E::last, &E::largest, &E::largest_at, &E::lasting, &E::least, &E::least_at, &E::pushed,
                              &E::folding, &E::most_folding})
      archive.item("tensions.element", e.*number);
}

}   // namespace cablenet::system

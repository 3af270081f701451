#include "cable_term.hpp"

#include <algorithm>
#include <type_traits>

#include "cablenet/elements/cable.hpp"
#include "cablenet/elements/static_law.hpp"
#include "element_loops.hpp"
#include "law_choice.hpp"

namespace cablenet::system {
namespace {

/// The slopes of an element at a body.
template <bool is_general>
struct ChordApart {
  std::array<Vector3, 2> forces;
  Matrix3 K_x, K_v;
  double m, damping;   ///< of the consistent matrix m [[2, 1], [1, 2]] [kg]; mass damping [1/s]

  template <class Kernel>
  bool fill(const Kernel& kernel, std::size_t i, const partition::LocalElement& e, const AnyNodes& nodes) {
    ChordResponse by_x;
    if (!kernel.template evaluate<true, true>(i, e, nodes, Shift{1, 0, 1}, by_x)) return false;
    forces = by_x.on;
    K_x = by_x.K;
    m = by_x.m;
    if constexpr (is_general) {
      ChordResponse by_v{};
      kernel.template evaluate<false, true>(i, e, nodes, Shift{1, 1, 0}, by_v);
      K_v = by_v.K - by_x.K;
      damping = by_v.m / m;
    }
    return true;
  }
  const Vector3& on(std::size_t i) const { return forces[i]; }
  Matrix3 x(std::size_t i, std::size_t j) const { return i == j ? K_x : Matrix3(-K_x); }
  auto v(std::size_t i, std::size_t j) const {
    if constexpr (is_general) {
      Matrix3 K = i == j ? K_v : Matrix3(-K_v);
      K.diagonal().array() += a(i, j) * damping;
      return K;
    } else {
      return NoSlope{};
    }
  }
  double a(std::size_t i, std::size_t j) const { return (i == j ? 2 : 1) * m; }
};

/// M (a + beta v) + (-f, +f) - weight/2 each.  [N]
template <class Law>
struct CableKernel {
  using Response = ChordResponse;
  using Apart = ChordApart<Law::general>;
  static constexpr bool owns_slots = true;

  const partition::LocalNetwork& network;
  const Law& law;
  const typename Law::Start* starts;
  elements::Turning turning;   ///< of the first element

  /// a + beta v of a node; the weight joins in as an acceleration.
  template <class Nodes, class Key>
  Vector3 inertial(const elements::CableMaterial& material, const Nodes& nodes, Key node) const {
    Vector3 q = nodes.a(node);
    if constexpr (Law::general) q += material.mass_damping * nodes.v(node);
    q.z() += network.gravity;
    return q;
  }

  elements::Turning turning_of(std::size_t i) const {
    return {turning.is_predicted, turning.last == nullptr ? nullptr : turning.last + i, turning.now + i, turning.least};
  }

  template <bool with_residual, bool with_tangent, class Nodes>
  bool evaluate(std::size_t i, const partition::LocalElement& e, const Nodes& nodes, const Shift& shift,
                Response& out) const {
    const elements::CableMaterial& material = network.materials[at(e.material)];
    const auto n1 = nodes.key(e, 0), n2 = nodes.key(e, 1);
    elements::ElementStage stage{material,        e.length, nodes.x(n2) - nodes.x(n1),
                                 Vector3::Zero(), shift.v,  turning_of(i)};
    if constexpr (Law::general) stage.w = nodes.v(n2) - nodes.v(n1);
    Vector3 f;
    if (!law.template evaluate<with_tangent>(starts[i], stage, f, out.K)) return false;
    if constexpr (with_residual) {
      const auto [on1, on2] =
          elements::cable_inertia(material, e.length, inertial(material, nodes, n1), inertial(material, nodes, n2));
      out.on = {on1 - f, on2 + f};
    }
    if constexpr (with_tangent) {
      const double sixth = material.mass_per_length * e.length / 6;
      out.m = sixth * shift.a;
      if constexpr (Law::general) out.m += sixth * material.mass_damping * shift.v;
    }
    return true;
  }
};

}   // namespace

CableTerm::CableTerm(const partition::LocalNetwork& network)
    : Term(network),
      is_general_(!std::all_of(network.materials.begin(), network.materials.end(), elements::is_elastic)) {}

bool CableTerm::is_symmetric(const ForceRule& rule) const {
  const auto is_damped = [](const auto& material) { return material.axial_damping > 0; };
  const bool has_damping = std::any_of(network_.materials.begin(), network_.materials.end(), is_damped);
  return rule.tangent == elements::Tangent::secant || (!rule.is_two_ended() && !has_damping);
}

template <class Law>
std::vector<typename Law::Start>& CableTerm::starts() {
  auto& array = std::get<std::vector<typename Law::Start>>(starts_);
  array.resize(network_.elements.size());
  return array;
}

void CableTerm::begin_step(Evaluation& evaluation) {
  before_ = taken_;
  const auto record = [&]<class Law>(const Law& law) {
    if constexpr (!std::is_same_v<typename Law::Start, elements::NoStart>) {
      auto& starts = this->starts<Law>();
      const auto visit = [&](Range range, const auto& nodes) {
        for (std::size_t i = at(range.first); i < at(range.last); ++i) {
          const partition::LocalElement& e = network_.elements[i];
          const auto n1 = nodes.key(e, 0), n2 = nodes.key(e, 1);
          law.begin(
              {network_.materials[at(e.material)], e.length, nodes.x(n2) - nodes.x(n1), nodes.v(n2) - nodes.v(n1)},
              starts[i]);
        }
      };
      visit(Range{0, network_.inner_elements}, InnerNodes{evaluation.data});
      visit(Range{network_.inner_elements, static_cast<int>(network_.elements.size())}, AnyNodes{evaluation.data});
    }
  };
  std::visit(record, choose_law(evaluation.rule, evaluation.situation, is_general_, before_));
}

/// The carried kernel asks twice, so that what is read and what is written are two arrays.
elements::Turning CableTerm::turning(const Evaluation& evaluation) {
  const TurningRule& rule = evaluation.target.turning;
  if (!evaluation.has_tangent || !rule.is_predicted) return {};
  directions_[0].swap(directions_[1]);
  for (auto& array : directions_) array.resize(network_.elements.size());
  return {true, rule.is_first ? nullptr : directions_[0].data(), directions_[1].data(), rule.least};
}

void CableTerm::add(Evaluation& evaluation) {
  const auto add_by = [&]<class Law>(const Law& law) {
    const CableKernel<Law> kernel{network_, law, starts<Law>().data(), turning(evaluation)};
    add_to_elements(evaluation, kernel, evaluation.target.shift);
  };
  std::visit(add_by, choose_law(evaluation.rule, evaluation.situation, is_general_, before_));
}

void CableTerm::add_energy(const LocalState& state, Energies& sum) const {
  for (const partition::LocalElement& e : own_elements()) {
    const elements::CableMaterial& material = network_.materials[at(e.material)];
    const auto [n1, n2] = e.node;
    const double height = 0.5 * (state.position(n1).z() + state.position(n2).z());
    sum.kinetic += elements::cable_kinetic_energy(material, e.length, state.velocity(n1), state.velocity(n2));
    sum.strain += elements::cable_strain_energy(material, e.length, state.chord(e).d);
    sum.gravity += material.mass_per_length * e.length * network_.gravity * height;
  }
}

void CableTerm::add_potential(const Situation& situation, const LocalState& state, double& sum) const {
  const auto& starts = std::get<std::vector<elements::StaticStart>>(starts_);
  for (std::size_t i = 0; i < own_elements().size(); ++i) {
    const partition::LocalElement& e = own_elements()[i];
    const double softened = i < starts.size() ? starts[i].softened : elements::StaticStart{}.softened;
    const double strain = (state.chord(e).d.norm() - e.length) / e.length;
    sum += e.length *
           elements::static_tension(situation.rule, network_.materials[at(e.material)], strain, softened).energy;
  }
}

/// The change of elongation in a step is that from the step's start before.
void CableTerm::archive(Archive& archive) {
  auto& reached = std::get<std::vector<elements::ReachedStart>>(starts_);
  std::vector<double> lengths, due;
  for (const auto& start : reached) {
    lengths.push_back(start.s.l);
    due.push_back(start.due);
  }
  archive.item("cables.taken_dt", taken_.dt);
  archive.item("cables.taken_pace", taken_.pace);
  archive.item("cables.lengths", lengths);
  archive.item("cables.due", due);
  reached.resize(lengths.size());
  for (std::size_t i = 0; i < reached.size(); ++i) {
    reached[i].s.l = lengths[i];
    reached[i].due = due[i];
  }
}

void CableTerm::add_scales(const LocalState& state, ForceSums& sums) const {
  for (const partition::LocalElement& e : own_elements()) {
    const elements::CableMaterial& material = network_.materials[at(e.material)];
    const double m = material.mass_per_length * e.length;
    const double speed = std::max(state.velocity(e.node[0]).norm(), state.velocity(e.node[1]).norm());
    const double tension = elements::cable_tension(material, e.length, state.chord(e));
    sums.load += square(tension) + square(m * network_.gravity) + square(m * speed * speed / e.length);
    sums.stiffness += square(2 * material.axial_stiffness / e.length);
    sums.mass += square(m);
  }
}

Vector3 CableTerm::end_force(const LocalState& state, int element, std::size_t end) const {
  const partition::LocalElement& e = network_.elements[at(element)];
  const elements::CableMaterial& material = network_.materials[at(e.material)];
  const auto [on1, on2] = elements::cable_end_forces(material, e.length, network_.gravity, state.chord(e),
                                                     state.inertial(e, material.mass_damping));
  return end == 0 ? on1 : on2;
}

}   // namespace cablenet::system

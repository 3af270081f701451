#include "cablenet/system/assembler.hpp"

#include <algorithm>
#include <type_traits>

#include "access.hpp"
#include "cablenet/petsc/object_state.hpp"
#include "cablenet/petsc/phase.hpp"
#include "element_loop.hpp"
#include "starts.hpp"

namespace cablenet::system {
namespace {

using petsc::check;

std::size_t at(int index) { return static_cast<std::size_t>(index); }

Eigen::Map<Vector3> as_vector(double* values) { return Eigen::Map<Vector3>(values); }

}   // namespace

Assembler::Assembler(partition::LocalNetwork network, ForceRule rule, MPI_Comm communicator)
    : network_(std::move(network)),
      rule_(rule),
      communicator_(communicator),
      is_elastic_(std::all_of(network_.materials.begin(), network_.materials.end(), elements::is_elastic)),
      ghosts_(network_, communicator),
      starts_(std::make_unique<Starts>()) {
  petsc::register_phases();
  outside_.resize(at(network_.nodes - network_.owned));
  outside_r_.resize(3 * outside_.size());
  prescribed_.resize(network_.prescribed.size());
}

Assembler::~Assembler() = default;

Vector Assembler::make_vector() const {
  Vector vector;
  check(VecCreate(communicator_, vector.out()));
  check(VecSetSizes(vector, 3 * network_.owned, 3 * network_.free_nodes));
  check(VecSetBlockSize(vector, 3));
  check(VecSetFromOptions(vector));
  return vector;
}

TangentMatrix Assembler::make_tangent() const {
  const bool rates = std::any_of(network_.materials.begin(), network_.materials.end(),
                                 [](const auto& material) { return material.axial_damping > 0; });
  const bool two_ended = rule_.scheme == scene::Scheme::energy_momentum;
  const bool symmetric = rule_.tangent == elements::Tangent::secant || (!two_ended && !rates);
  return {network_, symmetric, communicator_};
}

void Assembler::fill_initial(Vec x, Vec v) const {
  for (const auto& [vector, values] : {std::pair{x, &network_.position}, std::pair{v, &network_.velocity}}) {
    double* array = nullptr;
    check(VecGetArrayWrite(vector, &array));
    for (int i = 0; i < network_.owned; ++i) as_vector(array + 3 * std::ptrdiff_t{i}) = (*values)[at(i)];
    check(VecRestoreArrayWrite(vector, &array));
  }
}

void Assembler::set_prescribed(const Stage& s) {
  const bool new_end = s.dt != prescribed_dt_;
  const bool midpoint = rule_.scheme == scene::Scheme::energy_momentum;
  prescribed_dt_ = s.dt;
  for (std::size_t i = 0; i < prescribed_.size(); ++i) {
    NodeStep& step = prescribed_[i];
    const auto& [node, motion] = network_.prescribed[i];
    if (new_end) step.end = motion.at(s.t + s.dt);
    const auto& [x0, v0, a0] = step.start;
    const auto& [x1, v1, a1] = step.end;
    NodeMotion& here = outside_[at(node - network_.owned)];
    as_vector(here.x) = x0 + s.alpha_f * (x1 - x0);
    as_vector(here.v) = v0 + s.alpha_f * (v1 - v0);
    // The free nodes' a_a stands for the stage's time t + alpha_f dt.  With the mid-point rule it is (v1 - v0)/dt:
    // taken alike here, the energy of fixed and uniformly moved points balances exactly.
    as_vector(here.a) = midpoint && s.dt > 0 ? Vector3((v1 - v0) / s.dt) : Vector3(a0 + s.alpha_f * (a1 - a0));
  }
}

void Assembler::start_prescribed(double t) {
  prescribed_dt_ = -1;
  for (std::size_t i = 0; i < prescribed_.size(); ++i) prescribed_[i].start = network_.prescribed[i].motion.at(t);
}

template <class Visit>
void Assembler::visit_law(const Stage& stage, Visit&& visit) const {
  const auto choose = [&]<bool general>() {
    switch (rule_.scheme) {
      case scene::Scheme::energy_momentum:
        return visit(EnergyMomentumLaw<general>{rule_.tangent, stage.alpha_f, stage.dt, rule_.axial_dissipation});
      case scene::Scheme::generalized_alpha:
        return visit(AveragedLaw<general>{{rule_.tangent}, stage.alpha_f});
      case scene::Scheme::plain:
        return visit(StageLaw<general>{rule_.tangent});
    }
  };
  is_elastic_ ? choose.template operator()<false>() : choose.template operator()<true>();
}

void Assembler::begin_step(double t, Vec x, Vec v) {
  Access access(*this, x, v, nullptr, nullptr);
  evaluated_ = {};
  ghosts_.begin(access.data.x, access.data.v, nullptr, outside_.data());
  start_prescribed(t);
  for (std::size_t i = 0; i < prescribed_.size(); ++i) {
    NodeMotion& here = outside_[at(network_.prescribed[i].node - network_.owned)];
    as_vector(here.x) = prescribed_[i].start.x;
    as_vector(here.v) = prescribed_[i].start.v;
  }
  ghosts_.end();
  visit_law({}, [&](const auto& law) { record_starts(law, access); });
}

template <class Law>
void Assembler::record_starts(const Law&, const Access& access) {
  if constexpr (!std::is_same_v<typename Law::Start, NoStart>) {
    auto& starts = starts_->of<Law>(network_.elements.size());
    const auto record = [&](Range range, auto nodes) {
      for_each_element(network_, range, [&](std::size_t i, const partition::LocalElement& e) {
        const auto [n1, n2] = e.node;
        Vector3 w = Vector3::Zero();
        if constexpr (Law::general) w = difference(nodes.v(n2), nodes.v(n1));
        starts[i] = Law::start(network_.materials[at(e.material)], e.length, difference(nodes.x(n2), nodes.x(n1)), w);
        return true;
      });
    };
    record({0, network_.inner_elements}, InnerNodes{access.data});
    record({network_.inner_elements, static_cast<int>(network_.elements.size())}, AnyNodes{access.data});
  }
}

/// Elements between owned nodes first: the ghosts' motion arrives meanwhile.
template <class Law, bool with_residual, bool with_tangent>
bool Assembler::sweep(const Law& law, Access& access, const TangentRequest* request) {
  const auto& starts = starts_->of<Law>(network_.elements.size());
  TangentTarget target{};
  if constexpr (with_tangent)
    target = {request->matrix.open(), request->matrix.element_slots().data(), request->shift_v, request->shift_a};
  const auto visit = [&](Range range, auto nodes) {
    const ElementWork<Law, decltype(nodes), with_residual, with_tangent> work{network_, law, starts.data(), nodes,
                                                                              target};
    return for_each_element(network_, range, [&](std::size_t i, const partition::LocalElement& e) {
      if (work(i, e)) return true;
      coincident_ = network_.scene_element[i];
      return false;
    });
  };
  constexpr petsc::Phase phase = with_residual ? petsc::Phase::residual : petsc::Phase::tangent;
  const auto timed_visit = [&](Range range, auto nodes) {
    const petsc::Timer timer(phase);
    return visit(range, nodes);
  };
  bool in_domain = timed_visit({0, network_.inner_elements}, InnerNodes{access.data});
  access.finish_exchange();
  const Range rim{network_.inner_elements, static_cast<int>(network_.elements.size())};
  in_domain = timed_visit(rim, AnyNodes{access.data}) && in_domain;
  if constexpr (with_tangent) request->matrix.close();
  return in_domain;
}

template <class Law>
bool Assembler::run(const Law& law, Access& access, const TangentRequest* request) {
  if (!access.has_residual()) return sweep<Law, false, true>(law, access, request);
  return request == nullptr ? sweep<Law, true, false>(law, access, nullptr)
                            : sweep<Law, true, true>(law, access, request);
}

void Assembler::add_loads(Access& access, const TangentRequest* request) {
  const AnyNodes nodes{access.data};
  if (access.has_residual())
    for (const auto& [node, mass, force] : network_.loads)
      as_vector(nodes.r(node)) +=
          mass * (Eigen::Map<const Vector3>(nodes.a(node)) + Vector3(0, 0, network_.gravity)) - force;
  if (request == nullptr || network_.loads.empty()) return;
  const TangentTarget target{request->matrix.open(), nullptr, 0, 0};
  for (std::size_t i = 0; i < network_.loads.size(); ++i)
    put_block<AnyNodes>(target, request->matrix.load_slots()[i], 0, Matrix3::Zero(),
                        network_.loads[i].mass * request->shift_a);
  request->matrix.close();
}

bool Assembler::residual(const Stage& stage, Vec x, Vec v, Vec a, Vec r, const TangentRequest* request) {
  coincident_ = -1;
  evaluated_ = petsc::state_of(x);
  evaluated_stage_ = stage;
  Access access(*this, x, v, a, r);
  access.begin_exchange();
  set_prescribed(stage);
  bool in_domain = true;
  visit_law(stage, [&](const auto& law) { in_domain = run(law, access, request); });
  add_loads(access, request);
  return in_domain;
}

void Assembler::tangent(const Stage& stage, Vec x, Vec v, const TangentRequest& request) {
  Access access(*this, x, v, nullptr, nullptr);
  if (petsc::state_of(x) != evaluated_ || stage != evaluated_stage_) {
    access.begin_exchange();
    set_prescribed(stage);
    evaluated_ = petsc::state_of(x);
    evaluated_stage_ = stage;
  }
  visit_law(stage, [&](const auto& law) { run(law, access, &request); });
  add_loads(access, &request);
}

void Assembler::mass_matrix(TangentMatrix& mass) {
  const Vector none = make_vector();
  Access access(*this, none, none, nullptr, nullptr);
  const TangentRequest request{mass, 0, 1};
  run(NoLaw{}, access, &request);
  add_loads(access, &request);
}

void Assembler::force(double t, Vec x, Vec v, Vec force) {
  const Vector resting = make_vector();
  evaluated_ = {};
  Access access(*this, x, v, resting, force);
  access.begin_exchange();
  start_prescribed(t);
  set_prescribed({t, 0, 0});
  run(StageLaw<true>{rule_.tangent}, access, nullptr);
  add_loads(access, nullptr);
  access.close();
  check(VecScale(force, -1));
}

void Assembler::add_work(const Stage& s) {
  const double stage_t = s.t + s.alpha_f * s.dt;
  const double lag = s.t + 0.5 * s.dt - stage_t;
  // The reaction is known at the stage; work wants it at mid-step.
  const double slope = previous_stage_t_ < stage_t && lag != 0 ? lag / (stage_t - previous_stage_t_) : 0;
  for (std::size_t i = 0; i < prescribed_.size(); ++i) {
    NodeStep& step = prescribed_[i];
    const Vector3 reaction = as_vector(outside_r_.data() + 3 * at(network_.prescribed[i].node - network_.owned));
    const bool first = step.previous_reaction.isZero(0);
    const Vector3 middle = first ? reaction : Vector3(reaction + slope * (reaction - step.previous_reaction));
    work_ += middle.dot(step.end.x - step.start.x);
    step.previous_reaction = reaction;
  }
  previous_stage_t_ = stage_t;
}

}   // namespace cablenet::system

#include "cablenet/system/assembler.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../../src/system/block_pattern.hpp"
#include "../support/networks.hpp"
#include "cablenet/base/errors.hpp"
#include "cablenet/elements/cable.hpp"
#include "cablenet/petsc/queries.hpp"

using namespace cablenet;
using namespace cablenet::test;
using scene::Scheme;

namespace {

const std::string branched = R"(
environment: {gravity: 9.81}
points:
  tow: {position: [0, 0, 0], motion: {harmonic: {amplitude: [0.1, 0.2, 0.3], period: 0.8, phase: 20}}, mass: 5}
  tail: {position: [8, 1, -2], mass: 0.6, force: [0.5, -1, 2]}
  tip: {position: [3, -2, -3], mass: 1.2}
  side: {position: [4, 3, -2], motion: fixed}
cables:
  trunk: {type: rope, from: tow, to: tail, elements: 8, length: 8.2}
  branch: {type: damped, from: {cable: trunk, at: 3.1}, to: tip, elements: 4}
  stay: {type: slack, from: {cable: branch, at: 1.5}, to: side, elements: 3, length: 5.5}
)";

struct Case {
  const char* name;
  Scheme scheme;
  double xi;
  double radius;
  friend void PrintTo(const Case& item, std::ostream* out) { *out << item.name; }
};

/// A state within a step, and the shifts dv/dx and da/dx of TSALPHA2.
struct State {
  State(const network::Network& network, double radius) {
    stage = {0.3, 0.02, 1 / (1 + radius)};
    const double alpha_m = (2 - radius) / (1 + radius);
    const double gamma = 0.5 + alpha_m - stage.alpha_f;
    const double beta = 0.25 * (1 + alpha_m - stage.alpha_f) * (1 + alpha_m - stage.alpha_f);
    shift_v = gamma / (beta * stage.dt);
    shift_a = alpha_m / (stage.alpha_f * beta * stage.dt * stage.dt);
    const Field zero(network.position.size(), Vector3::Zero());
    x0 = disturbed(network.position, 0.3, 1);
    v0 = disturbed(zero, 2, 1000);
    x = disturbed(x0, 0.1, 2000);
    v = disturbed(v0, 1, 3000);
    a = disturbed(zero, 10, 4000);
    direction = disturbed(zero, 1, 5000);
    for (const auto& held : network.prescribed) direction[held.node].setZero();
  }
  system::Stage stage;
  double shift_v, shift_a;
  Field x0, v0, x, v, a, direction;
};

Field moved(const Field& field, double step, const Field& direction) {
  Field result = field;
  for (SceneNode node(0); node.value() < field.size(); ++node) result[node] += step * direction[node];
  return result;
}

Field residual(System& system, const State& s, double step) {
  const system::Vector r = system.assembler.make_vector();
  EXPECT_TRUE(system.assembler.residual(s.stage, system.vector(moved(s.x, step, s.direction)),
                                        system.vector(moved(s.v, step * s.shift_v, s.direction)),
                                        system.vector(moved(s.a, step * s.shift_a, s.direction)), r));
  return system.field(r);
}

/// The tangent times s.direction.
Field times_direction(System& system, const State& s, system::TangentMatrix& tangent) {
  const system::Vector product = system.assembler.make_vector();
  tangent.publish();
  petsc::check(MatMult(tangent.matrix(), system.vector(s.direction), product));
  return system.field(product);
}

Field tangent(System& system, const State& s) {
  system::TangentMatrix matrix = system.assembler.make_tangent();
  system.assembler.tangent(s.stage, system.vector(s.x), system.vector(s.v), system.vector(s.a),
                           {matrix, {1, s.shift_v, s.shift_a}});
  return times_direction(system, s, matrix);
}

class Assembler : public testing::TestWithParam<Case> {
protected:
  network::Network network_ = network_of(branched);
  system::ForceRule rule_{GetParam().scheme, GetParam().xi, elements::Tangent::exact};
  State state_{network_, GetParam().radius};
  System everywhere_{network_, rule_, PETSC_COMM_WORLD};
  System alone_{network_, rule_, PETSC_COMM_SELF};

  void begin(System& system) const {
    system.assembler.begin_step(state_.stage.t, system.vector(state_.x0), system.vector(state_.v0));
  }
};

}   // namespace

TEST_P(Assembler, TheJacobianIsTheResidualsDerivative) {
  begin(everywhere_);
  residual(everywhere_, state_, 0);
  const Field exact = tangent(everywhere_, state_);
  const double h = 1e-5;
  const Field ahead = residual(everywhere_, state_, h);
  const Field behind = residual(everywhere_, state_, -h);
  Field central = difference(ahead, behind);
  for (Vector3& value : central) value /= 2 * h;
  EXPECT_GT(size(exact), 1);
  EXPECT_LE(size(difference(central, exact)), 1e-6 * size(exact));
}

/// Inertia is linear and large.  Without it nothing hides an error in the internal force's tangent.
TEST_P(Assembler, TheJacobianOfTheInternalForceAlone) {
  state_.shift_a = 0;
  begin(everywhere_);
  residual(everywhere_, state_, 0);
  const Field exact = tangent(everywhere_, state_);
  const double h = 1e-6;
  Field central = difference(residual(everywhere_, state_, h), residual(everywhere_, state_, -h));
  for (Vector3& value : central) value /= 2 * h;
  EXPECT_LE(size(difference(central, exact)), 1e-6 * size(exact));
}

/// The tangent has the same values whether it comes with the residual or alone, and whatever the matrix held before.
TEST_P(Assembler, ResidualAndTangentInOnePass) {
  begin(everywhere_);
  const Field r = residual(everywhere_, state_, 0);
  const Field alone = tangent(everywhere_, state_);
  system::TangentMatrix matrix = everywhere_.assembler.make_tangent();
  const system::Vector both = everywhere_.assembler.make_vector();
  const system::TangentRequest request{matrix, {1, state_.shift_v, state_.shift_a}};
  for (int repetition = 0; repetition < 2; ++repetition) {
    everywhere_.assembler.residual(state_.stage, everywhere_.vector(state_.x), everywhere_.vector(state_.v),
                                   everywhere_.vector(state_.a), both, &request);
    EXPECT_EQ(size(difference(everywhere_.field(both), r)), 0);
    EXPECT_EQ(size(difference(times_direction(everywhere_, state_, matrix), alone)), 0);
  }
  matrix.set_identity(2.5);
  const Field nowhere(network_.position.size(), Vector3::Zero());
  EXPECT_EQ(size(difference(times_direction(everywhere_, state_, matrix), moved(nowhere, 2.5, state_.direction))), 0);
}

TEST_P(Assembler, AllNumbersOfRanksAgree) {
  begin(everywhere_);
  begin(alone_);
  const Field r = residual(everywhere_, state_, 0);
  const Field r_alone = residual(alone_, state_, 0);
  const Field product = tangent(everywhere_, state_);
  const Field product_alone = tangent(alone_, state_);
  EXPECT_LE(size(difference(r, r_alone)), 1e-12 * size(r_alone));
  EXPECT_LE(size(difference(product, product_alone)), 1e-12 * size(product_alone));
}

/// An element's nodes meet where the scheme takes the force: at the step's end, or in the plain scheme at the stage.
TEST_P(Assembler, CoincidentNodesAreNamed) {
  const int element = 5;
  const State usual = state_;
  const auto [from, to] = network_.elements[at(element)].node;
  const double left = GetParam().scheme == Scheme::plain ? 0 : 1 - state_.stage.alpha_f;
  state_.x0[from] = state_.x[from] = Vector3::Zero();
  state_.x0[to] = Vector3(1, 0, 0);
  state_.x[to] = Vector3(left, 0, 0);
  begin(everywhere_);
  const system::Vector r = everywhere_.assembler.make_vector();
  const system::Vector v = everywhere_.vector(state_.v), a = everywhere_.vector(state_.a);
  const bool fine = everywhere_.assembler.residual(state_.stage, everywhere_.vector(state_.x), v, a, r);
  const std::vector<int>& here = everywhere_.assembler.network().scene_element;
  const bool mine = std::find(here.begin(), here.end(), element) != here.end();
  EXPECT_EQ(fine, !mine);
  EXPECT_EQ(everywhere_.assembler.coincident_element(), mine ? element : -1);
  EXPECT_TRUE(everywhere_.assembler.residual(state_.stage, everywhere_.vector(usual.x), v, a, r));
  EXPECT_EQ(everywhere_.assembler.coincident_element(), -1);
}

TEST_P(Assembler, OtherTypesOfMatricesHoldTheSameTangent) {
  begin(everywhere_);
  const Field expected = tangent(everywhere_, state_);
  for (const std::string type : {"baij", "dense", "aijperm"}) {
    const Option option("-mat_type", type);
    system::TangentMatrix matrix = everywhere_.assembler.make_tangent();
    for (const double factor : {1.0, 2.0}) {
      const double shift_a = factor * state_.shift_a;
      everywhere_.assembler.tangent(state_.stage, everywhere_.vector(state_.x), everywhere_.vector(state_.v),
                                    everywhere_.vector(state_.a), {matrix, {1, state_.shift_v, shift_a}});
      const Field found = times_direction(everywhere_, state_, matrix);
      const double error = size(difference(found, expected)) / size(expected);
      EXPECT_EQ(error <= 1e-13, factor == 1) << type << ": " << error << " with a factor of " << factor;
    }
  }
}

/// A solver that is told so reads half of the matrix.
TEST_P(Assembler, TheTangentIsCalledSymmetricWhereItIs) {
  network::Network undamped = network_;
  for (auto& material : undamped.materials) material.axial_damping = 0;
  for (const network::Network& network : {network_, undamped})
    for (const auto kind : {elements::Tangent::exact, elements::Tangent::secant}) {
      System system(network, {GetParam().scheme, GetParam().xi, kind}, PETSC_COMM_WORLD);
      begin(system);
      system::TangentMatrix matrix = system.assembler.make_tangent();
      system.assembler.tangent(state_.stage, system.vector(state_.x), system.vector(state_.v), system.vector(state_.a),
                               {matrix, {1, state_.shift_v, 0}});
      const Field product = times_direction(system, state_, matrix);
      const system::Vector turned = system.assembler.make_vector();
      petsc::check(MatMultTranspose(matrix.matrix(), system.vector(state_.direction), turned));
      const double asymmetry = size(difference(system.field(turned), product)) / size(product);
      EXPECT_EQ(petsc::is_known_symmetric(matrix.matrix()), asymmetry <= 1e-13)
          << (kind == elements::Tangent::exact ? "exact" : "secant") << ": asymmetry of " << asymmetry;
    }
}

/// On every rank, though one alone has it.
TEST(TangentMatrix, ThatIsLongerThan32BitsCountIsRefused) {
  const int ranks = size_of(PETSC_COMM_WORLD);
  partition::LocalNetwork network;
  if (rank_of(PETSC_COMM_WORLD) == ranks - 1) network.owned = 240'000'000;
  try {
    system::BlockPattern(network).fix(PETSC_COMM_WORLD);
    ADD_FAILURE() << "2.16e9 values were taken";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("2.2e+09 values"), std::string::npos) << text;
    EXPECT_NE(text.find("at least " + std::to_string(ranks + 1) + " ranks"), std::string::npos) << text;
  }
}

/// In the plain scheme the residual is by definition the sum of the elements' functions at PETSc's stage.
TEST(AssemblerPlain, TheResidualIsTheElementsSum) {
  const network::Network network = network_of(branched);
  System system(network, {Scheme::plain, 0, elements::Tangent::exact}, PETSC_COMM_WORLD);
  const State s(network, 0.8);
  system.assembler.begin_step(s.stage.t, system.vector(s.x0), system.vector(s.v0));
  Field found = residual(system, s, 0), x = s.x, v = s.v, a = s.a;
  for (const auto& [node, motion] : network.prescribed) {
    const auto from = motion.at(s.stage.t), to = motion.at(s.stage.t + s.stage.dt);
    x[node] = from.x + s.stage.alpha_f * (to.x - from.x);
    v[node] = from.v + s.stage.alpha_f * (to.v - from.v);
    // Prescribed nodes accelerate as at the time of the forces, because the lagging accelerations of free nodes do too.
    a[node] = from.a + s.stage.alpha_f * (to.a - from.a);
  }
  Field expected(network.position.size(), Vector3::Zero());
  for (const auto& e : network.elements) {
    const auto& material = network.materials[at(e.material)];
    const SceneNode i = e.node[0], j = e.node[1];
    const double beta = material.mass_damping;
    const auto ends = elements::cable_end_forces(material, e.length, network.gravity, {x[j] - x[i], v[j] - v[i]},
                                                 {a[i] + beta * v[i], a[j] + beta * v[j]});
    expected[i] += ends.on1;
    expected[j] += ends.on2;
  }
  for (const auto& load : network.loads)
    expected[load.node] += load.mass * (a[load.node] + Vector3(0, 0, network.gravity)) - load.force;
  for (const auto& held : network.prescribed) expected[held.node].setZero();
  EXPECT_LE(size(difference(found, expected)), 1e-12 * size(expected));
}

INSTANTIATE_TEST_SUITE_P(Schemes, Assembler,
                         testing::Values(Case{"energy_momentum", Scheme::energy_momentum, 0, 1},
                                         Case{"energy_momentum_dissipating", Scheme::energy_momentum, 0.1, 1},
                                         Case{"generalized_alpha", Scheme::generalized_alpha, 0, 0.8},
                                         Case{"generalized_alpha_0", Scheme::generalized_alpha, 0, 0},
                                         Case{"plain", Scheme::plain, 0, 0.8}, Case{"plain_1", Scheme::plain, 0, 1}),
                         [](const auto& item) { return item.param.name; });

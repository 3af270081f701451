#include "cablenet/output/frames.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../support/networks.hpp"
#include "../support/scenes.hpp"
#include "cablenet/elements/cable.hpp"

using namespace cablenet;
using namespace cablenet::test;

namespace {

class Frames : public testing::TestWithParam<NamedScene> {
protected:
  static constexpr double t_ = 0.4;

  Frames() {
    for (const auto& [node, motion] : network_.prescribed) {
      const scene::Kinematics held = motion.at(t_);
      x_[node] = held.x;
      v_[node] = held.v;
    }
  }

  output::Frame collect(output::Frames& frames) {
    const system::LocalState& state =
        system_.assembler.observe(t_, system_.vector(x_), system_.vector(v_), system_.vector(x_));
    return frames.collect(state, 17);
  }

  network::Network network_ = network_of(GetParam().text);
  System system_{network_, {}, PETSC_COMM_WORLD};
  output::Frames frames_{network_, system_.partition, system_.assembler};
  Field x_ = disturbed(network_.position, 0.4, 5);
  Field v_ = disturbed(Field(network_.position.size(), Vector3::Zero()), 3, 500);
};

double tension(const network::Network& network, const network::Element& e, const Field& x, const Field& v) {
  return elements::cable_tension(network.materials[at(e.material)], e.length,
                                 {x[e.node[1]] - x[e.node[0]], v[e.node[1]] - v[e.node[0]]});
}

}   // namespace

TEST_P(Frames, TheMeshIsTheScenesInBlocks) {
  const output::Mesh& mesh = frames_.mesh();
  EXPECT_EQ(mesh.nodes, static_cast<std::int64_t>(network_.position.size()));
  EXPECT_EQ(mesh.elements, static_cast<std::int64_t>(network_.elements.size()));
  std::int64_t counts[] = {mesh.local_nodes, static_cast<std::int64_t>(mesh.lines.size())};
  std::int64_t before[] = {0, 0};
  MPI_Exscan(counts, before, 2, MPI_INT64_T, MPI_SUM, PETSC_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPI_INT64_T, MPI_SUM, PETSC_COMM_WORLD);
  EXPECT_EQ(mesh.first_node, rank_of(PETSC_COMM_WORLD) == 0 ? 0 : before[0]);
  EXPECT_EQ(mesh.first_element, rank_of(PETSC_COMM_WORLD) == 0 ? 0 : before[1]);
  EXPECT_EQ(counts[0], mesh.nodes);
  EXPECT_EQ(counts[1], mesh.elements);
  for (std::size_t i = 0; i < mesh.lines.size(); ++i) {
    const int element = static_cast<int>(mesh.first_element) + static_cast<int>(i);
    const auto& [from, to] = network_.elements[at(element)].node;
    EXPECT_EQ(mesh.lines[i], (std::array{from.value(), to.value()}));
    EXPECT_EQ(mesh.rank[i], system_.partition.element_owner[at(element)]);
    const network::Span& span = network_.spans[at(mesh.cable_id[i])];
    EXPECT_GE(element, span.first_element);
    EXPECT_LT(element, span.first_element + span.elements);
    EXPECT_EQ(mesh.cable_names[at(mesh.cable_id[i])], span.name);
  }
}

TEST_P(Frames, ValuesAreInTheScenesOrder) {
  const output::Frame frame = collect(frames_);
  const output::Mesh& mesh = frames_.mesh();
  EXPECT_EQ(frame.time, t_);
  EXPECT_EQ(frame.step, 17);
  EXPECT_EQ(frame.points.size(), static_cast<std::size_t>(3 * mesh.local_nodes));
  EXPECT_EQ(frame.velocity.size(), static_cast<std::size_t>(3 * mesh.local_nodes));
  EXPECT_EQ(frame.tension.size(), mesh.lines.size());
  EXPECT_EQ(frame.strain.size(), mesh.lines.size());
  for (std::size_t i = 0; i < frame.points.size(); ++i) {
    const SceneNode node(static_cast<int>(mesh.first_node) + static_cast<int>(i / 3));
    EXPECT_EQ(frame.points[i], x_[node](static_cast<int>(i % 3))) << "node " << node.value();
    EXPECT_EQ(frame.velocity[i], v_[node](static_cast<int>(i % 3))) << "node " << node.value();
  }
  for (std::size_t i = 0; i < frame.tension.size(); ++i) {
    const network::Element& e = network_.elements[static_cast<std::size_t>(mesh.first_element) + i];
    const double stretched = (x_[e.node[1]] - x_[e.node[0]]).norm();
    EXPECT_NEAR(frame.tension[i], tension(network_, e, x_, v_), 1e-10) << "element " << i;
    EXPECT_NEAR(frame.strain[i], stretched / e.length - 1, 1e-14) << "element " << i;
  }
}

TEST_P(Frames, ANodesTensionIsTheMeanOfItsElements) {
  Table<SceneNode, double> sum(network_.position.size(), 0), count(network_.position.size(), 0);
  for (const auto& e : network_.elements)
    for (const SceneNode node : e.node) {
      sum[node] += tension(network_, e, x_, v_);
      count[node] += 1;
    }
  for (int again = 0; again < 2; ++again) {
    const output::Frame frame = collect(frames_);
    EXPECT_EQ(frame.tension_node.size(), static_cast<std::size_t>(frames_.mesh().local_nodes));
    for (std::size_t i = 0; i < frame.tension_node.size(); ++i) {
      const SceneNode node(static_cast<int>(frames_.mesh().first_node) + static_cast<int>(i));
      EXPECT_NEAR(frame.tension_node[i], sum[node] / std::max(1.0, count[node]), 1e-10) << "node " << node.value();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Frames, testing::ValuesIn(kinds_of_networks),
                         [](const auto& scene) { return scene.param.name; });

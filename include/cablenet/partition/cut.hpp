#pragma once
#include <vector>

#include "cablenet/partition/graph.hpp"

/// Cutting a graph into parts that are eliminated each by itself, down to the interface between them.
/// Tests: tests/parallel/cut_test.cpp
namespace cablenet::partition {

/// The part of every vertex, so that the most expensive part costs little (step_cost).
/// With at least as many parts as vertices, some parts are empty and the others have one vertex each.
/// @param work  of each vertex in usual nodes' worth; all alike if empty
std::vector<int> cut_network(const Graph& graph, int parts, const std::vector<int>& work = {});

/// Per vertex: does it belong to the interface?  A few vertices with an end of every edge that joins two parts.
std::vector<bool> find_interface(const Graph& graph, const std::vector<int>& part);

/// What a node costs in a step, relative to each other: elimination takes a quarter of it, and twice as long where it
/// fills in.
inline constexpr int usual_cost = 4, filled_cost = 5;

/// Per vertex: usual_cost, or filled_cost where there is interface, or a loop, on more than one side, for each of its
/// nodes' worth.
std::vector<int> step_cost(const Graph& graph, const std::vector<bool>& interface, const std::vector<int>& work = {});

/// What couples the interface's vertices, in ascending order, once all others are eliminated: their own edges, and
/// all pairs at the same connected piece of the others.  Without vertices where that is far too much to eliminate.
Graph interface_graph(const Graph& graph, const std::vector<bool>& interface);

}   // namespace cablenet::partition

#pragma once
#include <vector>

#include "cablenet/partition/graph.hpp"

/// A graph is cut into parts, and each part is eliminated by itself.  The interface between the parts is left.
/// Tests: tests/parallel/cut_test.cpp
namespace cablenet::partition {

/// Finds the part of every vertex, such that the most expensive part (step_cost) is cheap.
/// With at least as many parts as vertices, each vertex has a part of its own, and the last parts are empty.
/// @param work  work of each vertex, in multiples of a usual node's; 1 for each if empty
std::vector<int> cut_network(const Graph& graph, int parts, const std::vector<int>& work = {});

/// Per vertex: does it belong to the interface?  The interface is a small set of vertices in which every edge between
/// two parts has an end.
std::vector<bool> find_interface(const Graph& graph, const std::vector<int>& part);

/// The relative costs of nodes in a step.  Elimination is a quarter of what a usual node costs.  It takes twice as long
/// for a node that it gives fill, so such a node costs 3 + 2.
inline constexpr int usual_cost = 4, filled_cost = 5;

/// The cost of each vertex in a step.  It is filled_cost for a vertex that has interface vertices or loops on more than
/// one side and is not in the interface itself, and usual_cost for any other, times the vertex's work.
/// @param work  as in cut_network
std::vector<int> step_cost(const Graph& graph, const std::vector<bool>& interface, const std::vector<int>& work = {});

/// The graph of the interface's vertices, in ascending order, once all other vertices are eliminated.  Two of them are
/// joined if they were neighbours, or if both are neighbours of the same connected piece of the other vertices.
/// @returns a graph without vertices where this one has far too many edges to be eliminated
Graph interface_graph(const Graph& graph, const std::vector<bool>& interface);

}   // namespace cablenet::partition

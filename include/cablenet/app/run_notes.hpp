#pragma once
#include <string>
#include <vector>

#include "cablenet/network/network.hpp"
#include "cablenet/solve/dynamics.hpp"
#include "cablenet/system/assembler.hpp"

/// What a run says at its end of results that hardly anybody means, or that depend on its steps.
/// Tests: tests/cases/notes.py
namespace cablenet::app {

/// Of the steps: they failed often, or they are too long for the motion.
std::vector<std::string> step_notes(const solve::StepFindings& steps, const solve::Counts& counts);

/// Of the cables: some pushed, some folded, or a tension lasted one step.  Collective.
/// @pre the assembler keeps tensions and has observed the run's end
std::vector<std::string> tension_notes(const scene::Scene& scene, const network::Network& network,
                                       system::Assembler& assembler);

}   // namespace cablenet::app

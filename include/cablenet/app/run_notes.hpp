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
/// @param lost  the energy that the step's formulas have taken, over the energy that moved; 0 where that is told
std::vector<std::string> step_notes(const solve::StepFindings& steps, const solve::Counts& counts, double lost);

/// The step with which neither a period nor the whole run would err by more than 1 %, and 0.1 % in water; 0 where it is
/// not known.  [s]
double step_for_accuracy(const solve::StepFindings& steps, double lost);

/// Of the cables: some pushed, some folded, or a tension lasted one step.  Collective.
/// @pre the assembler keeps tensions and has observed the run's end
/// @param total_share  what all steps err, each by itself, over the motion's way (StepFindings)
std::vector<std::string> tension_notes(const scene::Scene& scene, const network::Network& network,
                                       system::Assembler& assembler, double total_share);

}   // namespace cablenet::app

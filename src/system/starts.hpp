#pragma once
#include <tuple>

#include "cablenet/system/assembler.hpp"
#include "force_laws.hpp"

namespace cablenet::system {

/// A prescribed node at the two ends of the step.
struct Assembler::NodeStep {
  scene::Kinematics start;
  scene::Kinematics end;
  Vector3 previous_reaction = Vector3::Zero();
};

/// One array per kind of start; only that of the law in use has elements.
struct Assembler::Starts {
  template <class Law>
  std::vector<typename Law::Start>& of(std::size_t elements) {
    auto& array = std::get<std::vector<typename Law::Start>>(arrays);
    array.resize(elements);
    return array;
  }

  std::tuple<std::vector<NoStart>, std::vector<AveragedStart<false>>, std::vector<AveragedStart<true>>,
             std::vector<elements::Stretch>>
      arrays;
};

}   // namespace cablenet::system

#pragma once
#include <tuple>

#include "cablenet/system/assembler.hpp"
#include "force_laws.hpp"

namespace cablenet::system {

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

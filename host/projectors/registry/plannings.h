#pragma once

#include <cstdint>
#include <vector>

#include "projectors/planning.h"

namespace prelight {

/// Where techniques come one after the other before a bake. Plans in files and keys of states depend on it.
enum class PlanningOrder : std::uint8_t {
  Plan,  ///< passes
  Key,   ///< what a state depends on
};

/// Of all techniques that a bake can be asked for.
std::vector<Planning> plannings(PlanningOrder order);

}  // namespace prelight

#pragma once

#include <cstdint>
#include <vector>

#include "techniques/planning.h"

namespace prelight {

/// Where techniques come one after the other in a bake. Plans in files, keys of states and reports depend on
/// it.
enum class PlanningOrder : std::uint8_t {
  Plan,  ///< passes
  Key,   ///< what a state depends on
  Run,   ///< projectors: what reads of a bake runs after what writes it
};

/// The planning of every technique that a bake can be asked for.
std::vector<Planning> plannings(PlanningOrder order);

}  // namespace prelight

#pragma once

#include <cstdint>
#include <vector>

#include "techniques/technique.h"

namespace prelight {

/// Where techniques come one after the other. The orders differ, and stay: bytes of files and what `info`
/// prints depend on them.
enum class Order : std::uint8_t {
  Entry,    ///< members of a primitive's entry in a file, and their accessors
  Root,     ///< members of the root's extension, and their accessors
  Summary,  ///< what `info` tells of a bake
};

/// All techniques.
std::vector<Technique> techniques(Order order);

/// Describes every technique of a bake of `vertices` vertices.
std::vector<BakedSummary> summariesOf(const Bake& bake, std::size_t vertices);

}  // namespace prelight

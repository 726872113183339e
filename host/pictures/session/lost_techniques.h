#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "prelight/bake.h"

namespace prelight::pictures {

/// The names that a file's extension has for the techniques of a bake of `vertices` vertices.
std::vector<std::string> techniqueKeys(const Bake& bake, std::size_t vertices);

/// Those of the techniques `had` that are not in `kept`, "haar, vo"; empty: nothing is lost.
std::string lostTechniques(const std::vector<std::string>& had, const Bake& kept, std::size_t vertices);

}  // namespace prelight::pictures

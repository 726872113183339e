#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>

#include "benchmarks/run/measure.h"

namespace prelight::benchmarks {

/// Returns the glTF node of a mesh or a lamp by its name, or -1.
int nodeOf(const BenchmarkScene& scene, const std::string& name);

/// Returns the root of the mean squared difference of luminance, as a share of the mean of `truth`.
double relativeError(std::span<const glm::vec3> got, std::span<const glm::vec3> truth);

}  // namespace prelight::benchmarks

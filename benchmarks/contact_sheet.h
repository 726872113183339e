#pragma once

#include "benchmarks/canvas.h"
#include "benchmarks/technique_trial.h"

namespace prelight::benchmarks {

/// The truth and every technique's picture beside one another, each with its name, errors and costs.
Canvas drawContactSheet(const SceneComparison& scene);

/// A picture of `width` x `height` pixels made `newWidth` wide, each new pixel the mean of the area that it
/// covers.
std::vector<glm::vec3> shrink(std::span<const glm::vec3> pixels, int width, int height, int newWidth);

}  // namespace prelight::benchmarks

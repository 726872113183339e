#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "plot/drawing.h"

/// Pictures of basis functions.
namespace prelight::plot {

/// Writes the values of all functions of an order in a unit direction, order^2 of them.
using EvaluateBasis = std::function<void(const glm::dvec3& direction, int order, std::span<double> values)>;

/// Returns the harmonics of an order as a pyramid: a row per band, m from -l to l.
Drawing plotHarmonics(const EvaluateBasis& evaluate, int order);

/// Returns the wavelets of one face of a cube map, where the coefficient of each lies in the transformed
/// face: blue is positive, orange negative. The face has faceSize texels along a side, 2, 4 or 8, and
/// `values` holds the wavelets' values there, [wavelet][texel].
Drawing plotWavelets(int faceSize, const std::vector<double>& values);

}  // namespace prelight::plot

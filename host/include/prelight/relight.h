#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/transfer.h"

namespace prelight {

/// Irradiance (W/m2) of vertices, or of texels, under light from afar: pi sum_i L_i T_i, bounces included, in
/// floats on all cores. `light` is [channel][i], 3 x order^2: for SH its coefficients (projectSky()), for CH
/// its moments (chMomentsFromSh()). A transfer of fewer bands takes those that it has: light may be of a
/// higher order, `lightOrder`. Throws UsageError for light of a lower order or another length.
std::vector<glm::vec3> irradiance(const HarmonicTransfer& transfer, std::span<const double> light,
                                  int lightOrder);

/// The same of Haar wavelets: `light` is [channel][i], 3 x 6 faceSize^2, as haarForward() makes it of
/// cubeOfSky().
std::vector<glm::vec3> irradiance(const HaarTransfer& transfer, std::span<const float> light);

/// The same of the scene's own lights, each group of its own colour.
std::vector<glm::vec3> irradiance(const LightGroupTransfer& transfer, std::span<const glm::vec3> colors);

}  // namespace prelight

#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/transfer.h"

namespace prelight {

/// Returns the irradiance (W/m2) of vertices or texels under distant light, bounces included: pi sum_i L_i
/// T_i, computed in floats on all cores. `light` is [channel][i], 3 x lightOrder^2: SH coefficients
/// (projectSky()) for SH, moments (chMomentsFromSh()) for CH. `lightOrder` may exceed the order of the
/// transfer, which ignores the higher bands. Throws UsageError for light of a lower order or of another
/// length.
std::vector<glm::vec3> irradiance(const HarmonicTransfer& transfer, std::span<const double> light,
                                  int lightOrder);

/// Returns the irradiance by transfer in Haar wavelets. `light` is [channel][i], 3 x 6 faceSize^2, from
/// haarForward() of cubeOfSky().
std::vector<glm::vec3> irradiance(const HaarTransfer& transfer, std::span<const float> light);

/// Returns the irradiance due to the scene's own lights, with a colour per group.
std::vector<glm::vec3> irradiance(const LightGroupTransfer& transfer, std::span<const glm::vec3> colors);

}  // namespace prelight

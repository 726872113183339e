#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/picture.h"

/// Haar wavelets as values on texels, for pictures of them.
namespace prelight {

/// Returns the values of the wavelets of one face of a cube map, [wavelet][row][column]; the index of a
/// wavelet is the texel of its coefficient.
std::vector<double> faceWavelets(int faceSize);

/// Returns the radiance of a cube map's texels, [face][row][column], that is left of a sky when only its
/// greatest coefficients are kept. Throws as cubeFromEnvironment().
std::vector<glm::vec3> skyOfWavelets(const Environment& sky, int faceSize, std::size_t kept);

}  // namespace prelight

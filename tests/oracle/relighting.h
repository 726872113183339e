#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/haar.h"
#include "prelight/transfer.h"

/// Slow relighting in double precision as the oracle of the kernels. Colours are radiance before albedo,
/// [vertex]. For transfer in spherical harmonics see relight() in compress/compression_error.h.
namespace prelight::reference {

std::vector<glm::dvec3> relightGroups(const LightGroupTransfer& transfer, std::span<const glm::dvec3> colors);

std::vector<glm::dvec3> relightHaar(const HaarTransfer& transfer, std::span<const haar::LitWavelet> light);

/// Returns the coefficients of light arriving at glossy receivers, [vertex][3][i].
std::vector<double> lightMatrices(const GlossyTransfer& transfer, std::span<const double> light);

/// Returns shaded colours. `arriving` is the result of lightMatrices(); directions and lobe are as in
/// GlossyRelighter::shade.
std::vector<glm::dvec3> shadeGlossy(std::span<const double> arriving, int order,
                                    std::span<const glm::dvec3> directions, std::span<const double> lobe);

}  // namespace prelight::reference

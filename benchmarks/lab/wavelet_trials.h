#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/cube_overlap.h"
#include "basis/haar.h"
#include "prelight/transfer.h"

namespace prelight {

/// Returns the map that takes the value of the one source texel from which the centre of a texel came (Sherif
/// 6.6.3). It does not preserve flux and jumps as the rotation grows; it exists to show the difference.
CubeResampling rotateByPoint(const glm::dmat3& rotation, int faceSize);

}  // namespace prelight

/// Other ways to choose wavelets than those of host/basis/haar.h.
namespace prelight::haar {

/// Returns the integral of every wavelet's magnitude over its support, in sr: with these weights selection is
/// area-weighted (Ng et al. 2003). A transfer coefficient is at most this divided by pi. [6 S^2]
std::vector<float> areaWeights(int faceSize);

/// Returns the coefficients of selectLight(), faded in as they exceed the greatest magnitude t that is left
/// out: they are multiplied by (1 - t/m) fade / (fade - 1) for magnitudes m up to fade x t, and by 1 beyond;
/// fade > 1. The result is a continuous function of the light.
SparseLight selectLightSoftly(std::span<const float> light, std::span<const float> weights, std::size_t count,
                              float fade);

/// Drops coefficients of every row as keepError() does.
HaarTransfer keepRows(const HaarTransfer& transfer, double relativeError);

/// The basis that represents a light with less error.
struct BasisChoice {
  bool haar = false;
  double shError = 0.0;    ///< expectedError() of the bands that SH of the order lacks
  double haarError = 0.0;  ///< expectedError() of the Haar coefficients that are not selected
};

/// Compares SH of `shOrder` with the light's `haarCount` most important Haar coefficients, both by
/// expectedError(). SH is chosen for smooth skies, Haar for small lights.
BasisChoice chooseBasis(const CubeMap& light, int shOrder, std::size_t haarCount,
                        std::span<const float> weights);

}  // namespace prelight::haar

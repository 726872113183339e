#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/haar_selection.h"
#include "prelight/bake.h"

/// Lighting by sparse Haar transfer in double precision: what kernels and shaders are compared with.
namespace prelight::haar {

/// Root mean square over vertices and channels of every transfer coefficient: the weights by which a light's
/// coefficients are chosen. [6 S^2]
std::vector<float> coefficientRms(const HaarTransfer& transfer);

/// Sum of light times transfer over all coefficients of the light, [channel][i]: exit radiance over albedo at
/// every vertex.
std::vector<glm::dvec3> relight(const HaarTransfer& transfer, std::span<const float> light);

/// The same with a part of the light's coefficients.
std::vector<glm::dvec3> relight(const HaarTransfer& transfer, const SparseLight& light);

/// Appends a row; rows come in the order [vertex][channel]. An empty transfer begins with offsets {0}.
void appendRow(HaarTransfer& transfer, const SparseRow& row);

/// Light that a vertex gets from another: the share of its cosine-weighted hemisphere that it sees of the
/// sender, times the sender's albedo. A channel each.
struct Link {
  std::uint32_t sender = 0;
  glm::vec3 weight{0.0f};
};

/// The light that one more bounce carries (Sherif 6.6.4): row v is the sum of the senders' rows of
/// `previous`, the bounce before, times their weights. The transfer with bounces is the sum of all of them.
/// Coefficients are dropped up to `relativeError` as in keepError(). The result has three channels.
HaarTransfer gatherBounce(const HaarTransfer& previous, std::span<const std::vector<Link>> links,
                          double relativeError);

/// Drops coefficients of every row as keepError() does.
HaarTransfer keepRows(const HaarTransfer& transfer, double relativeError);

/// Sum of two transfers of as many vertices, with as many channels as the one that has more.
HaarTransfer addTransfer(const HaarTransfer& a, const HaarTransfer& b);

/// Which basis shows a light with less error.
struct BasisChoice {
  bool haar = false;
  double shError = 0.0;    ///< expectedError() of what SH of the order leaves out
  double haarError = 0.0;  ///< of what the chosen number of Haar coefficients leaves out
};

/// Compares SH of `shOrder` with the light's `haarCount` most important coefficients, both by
/// expectedError(). Smooth skies end up with SH, small lights with Haar.
BasisChoice chooseBasis(const CubeMap& light, int shOrder, std::size_t haarCount,
                        std::span<const float> weights);

}  // namespace prelight::haar

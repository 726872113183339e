#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/haar.h"
#include "prelight/bake.h"

/// Lighting by sparse Haar transfer in double precision: the oracle of kernels and shaders.
namespace prelight::haar {

/// Returns the root mean square over vertices and channels of every transfer coefficient, [6 S^2], which
/// weights the selection of a light's coefficients.
std::vector<float> coefficientRms(const HaarTransfer& transfer);

/// Returns the sum of light times transfer over all coefficients of the light, [channel][i]: exit radiance
/// over albedo at every vertex.
std::vector<glm::dvec3> relight(const HaarTransfer& transfer, std::span<const float> light);

/// Returns that sum over a part of the light's coefficients.
std::vector<glm::dvec3> relight(const HaarTransfer& transfer, const SparseLight& light);

/// Returns the sum of light times transfer at one vertex.
glm::dvec3 relightVertex(const HaarTransfer& transfer, std::size_t vertex, const SparseRow& light);

/// Appends a row; rows are in the order [vertex][channel]. An empty transfer must have offsets {0}.
void appendRow(HaarTransfer& transfer, const SparseRow& row);

/// Light that a vertex receives from another vertex, per channel: the share of the receiver's cosine-weighted
/// hemisphere that it occupies times its albedo. `sender` is the emitting vertex.
struct Link {
  std::uint32_t sender = 0;
  glm::vec3 weight{0.0f};
};

/// Returns the transfer of one more bounce (Sherif 6.6.4): row v is the sum of the senders' rows of the
/// bounce before, `previous`, times their weights. Total transfer is the sum of all bounces. Coefficients are
/// dropped up to `relativeError` as in keepError(). The result has three channels.
HaarTransfer gatherBounce(const HaarTransfer& previous, std::span<const std::vector<Link>> links,
                          double relativeError);

/// Returns the sum of two transfers with equal vertices, and as many channels as the larger number of theirs.
HaarTransfer addTransfer(const HaarTransfer& a, const HaarTransfer& b);

}  // namespace prelight::haar

#include "viewer/techniques/series/cluster_transfer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "basis/sh.h"
#include "relight/device/compressed_light.h"
#include "viewer/lights/receiver_lamps.h"

namespace prelight::viewer {
namespace {

/// Everything but what belongs to vertices.
CompressedTransfer withoutVertices(const CompressedTransfer& transfer) {
  CompressedTransfer shared = transfer;
  shared.clusterOf.clear();
  shared.weightFloats.clear();
  shared.weightHalves.clear();
  shared.weightBytes.clear();
  return shared;
}

gl::BufferTexture uploadClusters(const CompressedTransfer& transfer) {
  if (!transfer.clusterOf.empty())
    return gl::makeBufferTexture(std::span<const std::uint16_t>(transfer.clusterOf), 1, GL_R16UI, "clusters");
  const std::vector<std::uint16_t> first(transfer.vertexCount, 0);
  return gl::makeBufferTexture(std::span<const std::uint16_t>(first), 1, GL_R16UI, "clusters");
}

gl::BufferTexture uploadWeights(const CompressedTransfer& transfer) {
  switch (transfer.weights) {
    case WeightStorage::Float:
      return gl::makeBufferTexture(std::span<const float>(transfer.weightFloats), 1, GL_R32F, "weights");
    case WeightStorage::Half:
      return gl::makeBufferTexture(std::span<const std::uint16_t>(transfer.weightHalves), 1, GL_R16F,
                                   "weights");
    case WeightStorage::Byte:
      break;
  }
  return gl::makeBufferTexture(std::span<const std::uint8_t>(transfer.weightBytes), 1, GL_R8, "weights");
}

/// Mean of the channels, [vertex]: the radiance under a sky of radiance 1, whose only coefficient is the
/// first.
std::vector<float> clusterAccessibility(const CompressedTransfer& transfer) {
  const auto count = static_cast<std::size_t>(sh::coefficientCount(transfer.order));
  std::vector<double> sky(3 * count, 0.0);
  for (std::size_t c = 0; c < 3; ++c) sky[c * count] = std::sqrt(4.0 * std::numbers::pi);
  std::vector<float> result;
  for (const glm::dvec3& exit : relight(transfer, lightOf(transfer, sky)))
    result.push_back(static_cast<float>(std::clamp((exit.x + exit.y + exit.z) / 3.0, 0.0, 1.0)));
  return result;
}

/// Means and components of the clusters, as weights are stored: [cluster][1 + component][channel][i], rows of
/// channels padded to whole texels.
std::vector<float> clusterRows(const CompressedTransfer& transfer) {
  const std::size_t d = transfer.dimension(), n = d / static_cast<std::size_t>(transfer.channels);
  const auto k = static_cast<std::size_t>(transfer.components);
  const std::size_t padded = (n + 3) / 4 * 4, length = padded * static_cast<std::size_t>(transfer.channels);
  std::vector<float> rows(static_cast<std::size_t>(transfer.clusters) * (1 + k) * length, 0.0f);
  const auto add = [&](std::size_t row, const float* vector, float factor) {
    for (std::size_t i = 0; i < d; ++i) rows[row * length + i / n * padded + i % n] += factor * vector[i];
  };
  for (std::size_t cluster = 0; cluster < static_cast<std::size_t>(transfer.clusters); ++cluster) {
    const std::size_t first = cluster * (1 + k);
    add(first, transfer.means.data() + cluster * d, 1.0f);
    for (std::size_t j = 0; j < k; ++j) {
      const std::size_t at = cluster * k + j;
      const bool bytes = transfer.weights == WeightStorage::Byte;
      const float* component = transfer.basis.data() + at * d;
      if (bytes) add(first, component, transfer.weightRanges[2 * at]);
      add(first + 1 + j, component, bytes ? transfer.weightRanges[2 * at + 1] : 1.0f);
    }
  }
  return rows;
}

}  // namespace

ClusterTransfer::ClusterTransfer(const CompressedTransfer& transfer, const CompiledScene& scene)
    : shared_(withoutVertices(transfer)),
      clusters_(uploadClusters(transfer)),
      weights_(uploadWeights(transfer)),
      accessibility_(Attribute::Accessibility, std::span<const float>(clusterAccessibility(transfer))),
      pass_(scene) {}

void ClusterTransfer::light(const Illumination& light) {
  std::vector<glm::vec4> texels;
  for (const auto& sky : {skyCoefficients(light, shared_.order), smoothedCoefficients(light, shared_.order)})
    for (const glm::vec3& term : lightOf(shared_, byChannel(sky)).terms) texels.emplace_back(term, 0.0f);
  terms_ = gl::makeBufferTexture(texels, "lit clusters");
  const std::vector<ShadedLight> lamps = transferredLights(light);
  if (!lamps.empty() && !rows_)
    rows_ = gl::makeBufferTexture(std::span<const float>(clusterRows(shared_)), 4, GL_RGBA32F, "clusters");
  pass_.run(lamps, [&](const gl::Program& program) {
    program.set("transferForm", static_cast<int>(TransferForm::Clusters));
    program.set("transferShape",
                glm::ivec4(shared_.components, shared_.channels, shared_.order, shared_.clusters));
    // OpenGL reads bytes as 0 to 1.
    program.set("weightScale", shared_.weights == WeightStorage::Byte ? 255.0f : 1.0f);
    gl::bind(transferUnit, GL_TEXTURE_BUFFER, weights_.texture);
    gl::bind(transferLightUnit, GL_TEXTURE_BUFFER, terms_.texture);
    program.set("transferIsCh", 0);
    program.set("transferRows", static_cast<int>(TransferRow::Front));
    gl::bind(clustersUnit, GL_TEXTURE_BUFFER, clusters_.texture);
    if (rows_) gl::bind(clusterRowsUnit, GL_TEXTURE_BUFFER, rows_->texture);
  });
}

void ClusterTransfer::bind(const gl::Program&) const {
  accessibility_.attach();
  pass_.attach();
}

}  // namespace prelight::viewer

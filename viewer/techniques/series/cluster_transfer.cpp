#include "viewer/techniques/series/cluster_transfer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "basis/sh.h"
#include "relight/compressed_light.h"

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

}  // namespace

ClusterTransfer::ClusterTransfer(const CompressedTransfer& transfer, const CompiledScene& scene)
    : shared_(withoutVertices(transfer)),
      clusters_(uploadClusters(transfer)),
      weights_(uploadWeights(transfer)),
      accessibility_(Attribute::Accessibility, std::span<const float>(clusterAccessibility(transfer))),
      pass_(scene) {}

void ClusterTransfer::light(const Illumination& light) {
  const auto far = farCoefficients(light, shared_.order, FarLights::All);
  std::vector<glm::vec4> texels;
  for (const glm::vec3& term : lightOf(shared_, byChannel(far)).terms) texels.emplace_back(term, 0.0f);
  terms_ = gl::makeBufferTexture(texels, "lit clusters");
  pass_.run({}, [&](const gl::Program& program) {
    program.set("transferForm", static_cast<int>(TransferForm::Clusters));
    program.set("transferShape", glm::ivec4(shared_.components, shared_.channels, 0, 0));
    // OpenGL reads bytes as 0 to 1.
    program.set("weightScale", shared_.weights == WeightStorage::Byte ? 255.0f : 1.0f);
    gl::bind(transferUnit, GL_TEXTURE_BUFFER, weights_.texture);
    gl::bind(transferLightUnit, GL_TEXTURE_BUFFER, terms_.texture);
    gl::bind(clustersUnit, GL_TEXTURE_BUFFER, clusters_.texture);
  });
}

void ClusterTransfer::bind(const gl::Program&) const {
  accessibility_.attach();
  pass_.attach();
}

void ClusterTransfer::describe(const Illumination& light, Warnings& notes) const {
  noteFarLights(light, "clustered transfer", notes);
}

}  // namespace prelight::viewer

#include "projectors/pack_bake.h"

#include <algorithm>
#include <cmath>

#include "basis/ch.h"

namespace prelight {

namespace {

float finiteOr(double value, float fallback) {
  const auto f = static_cast<float>(value);
  return std::isfinite(f) ? f : fallback;
}

/// [vertex], unit. The mean of directions above the surface is above it too, whatever the fit overshoots.
std::vector<glm::vec3> bentNormals(const SideCast& front, const FitMesh& mesh, const CompiledScene& scene) {
  const std::vector<double> fitted = front.solveBentNormal();
  std::vector<glm::vec3> normals;
  normals.reserve(scene.vertexCount());
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const std::size_t slot = mesh.slotOfVertex[v];
    const glm::dvec3 n = glm::normalize(glm::dvec3(scene.normals[v]));
    glm::dvec3 bent = n + glm::dvec3(fitted[3 * slot], fitted[3 * slot + 1], fitted[3 * slot + 2]);
    bent -= std::min(0.0, glm::dot(bent, n)) * n;
    const double length = glm::length(bent);
    // Where nothing is open there is no mean direction; the normal is as good as any.
    normals.push_back(length > 1e-5 ? glm::vec3(bent / length) : glm::vec3(n));
  }
  return normals;
}

/// Calls write(coefficients of SH, out) for every vertex and channel; out takes `width` floats.
template <typename Write>
std::vector<float> packRows(const FitMesh& mesh, const SlotTransfer& transfer, const CompiledScene& scene,
                            int channels, std::size_t width, const Write& write) {
  std::vector<float> packed(scene.vertexCount() * static_cast<std::size_t>(channels) * width);
  float* out = packed.data();
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c, out += width)
      write(&transfer.total[(mesh.slotOfVertex[v] * 3 + c) * transfer.columns()], out);
  return packed;
}

}  // namespace

std::vector<double> accessibilityOf(const FitMesh& mesh, const SideCast& front,
                                    const std::vector<double>& fitted) {
  std::vector<double> accessibility;
  for (std::size_t slot = 0; slot < mesh.slotCount(); ++slot)
    accessibility.push_back(std::clamp(1.0 + fitted[slot * front.baseline().columns()], 0.0, 1.0));
  return accessibility;
}

void packAo(const FitMesh& mesh, const SideCast& front, const std::vector<double>& accessibility,
            const CompiledScene& scene, Bake& bake) {
  bake.bentNormals = bentNormals(front, mesh, scene);
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    bake.ao.push_back(finiteOr(accessibility[mesh.slotOfVertex[v]], 1.0f));
}

HarmonicTransfer packSh(const FitMesh& mesh, const SlotTransfer& transfer, const CompiledScene& scene,
                        int order) {
  const auto n = static_cast<std::size_t>(order * order);
  return {order, transfer.channels(), transfer.bounces,
          packRows(mesh, transfer, scene, transfer.channels(), n,
                   [&](const double* row, float* out) {
                     for (std::size_t i = 0; i < n; ++i) out[i] = finiteOr(row[i], 0.0f);
                   }),
          false};
}

HarmonicTransfer packCh(const FitMesh& mesh, const SlotTransfer& transfer, const CompiledScene& scene,
                        int order, bool naive) {
  const auto n = static_cast<std::size_t>(order * order);
  const ch::Basis basis(order);
  std::vector<double> coefficients(n);
  return {order, transfer.channels(), transfer.bounces,
          packRows(mesh, transfer, scene, transfer.channels(), n,
                   [&](const double* row, float* out) {
                     const std::span<const double> sh(row, n);
                     naive ? basis.momentsFromSh(sh, coefficients) : basis.fromSh(sh, coefficients);
                     for (std::size_t i = 0; i < n; ++i) out[i] = finiteOr(coefficients[i], 0.0f);
                   }),
          naive};
}

LightGroupTransfer packLightGroups(const FitMesh& mesh, const SlotTransfer& transfer,
                                   const CompiledScene& scene, const std::vector<LightGroup>& groups,
                                   int channels) {
  const std::size_t first = transfer.shColumns(), n = groups.size();
  return {groups, channels, transfer.bounces,
          packRows(mesh, transfer, scene, channels, n, [&](const double* row, float* out) {
            // Light is never negative; a fit may dip below.
            for (std::size_t g = 0; g < n; ++g) out[g] = std::max(0.0f, finiteOr(row[first + g], 0.0f));
          })};
}

GlossyTransfer packGlossy(const FitMesh& mesh, const SlotTransfer& transfer,
                          const std::vector<float>& matrices, const CompiledScene& scene, int order) {
  const auto width = static_cast<std::size_t>(transfer.channels() * order * order * order * order);
  GlossyTransfer glossy{order, transfer.channels(), transfer.bounces, {}};
  glossy.matrices.reserve(scene.vertexCount() * width);
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    for (std::size_t i = 0; i < width; ++i)
      glossy.matrices.push_back(finiteOr(matrices[mesh.slotOfVertex[v] * width + i], 0.0f));
  return glossy;
}

}  // namespace prelight

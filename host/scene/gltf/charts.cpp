#include "scene/gltf/charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scene/surface/image_lookup.h"
#include "scene/surface/tangent_space.h"
#include "scene/surface/uv_raster.h"

namespace prelight {

namespace {

// Coordinates that rounding put this far outside are moved to the border.
constexpr float borderSlack = 1e-4f;
constexpr int trialSize = 512;         // test points per side in the search for overlaps
constexpr double mostOverlap = 0.005;  // share of the covered points

using PlacedPrimitives = std::map<std::pair<int, int>, const Primitive*>;  ///< by node, primitive

PlacedPrimitives placePrimitives(const Scene& scene) {
  PlacedPrimitives placed;
  for (const MeshNode& node : scene.meshNodes) {
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(node.mesh)];
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p)
      placed[{node.node, static_cast<int>(p)}] = &mesh.primitives[p];
  }
  return placed;
}

double uvArea(const std::vector<glm::vec2>& coords, const std::vector<glm::uvec3>& triangles) {
  double sum = 0.0;
  for (const glm::uvec3& t : triangles) {
    const glm::dvec2 b(coords[t.y] - coords[t.x]), c(coords[t.z] - coords[t.x]);
    sum += 0.5 * std::abs(b.x * c.y - b.y * c.x);
  }
  return sum;
}

/// Returns why texture coordinates make no chart; empty when they do. Moves coordinates just outside to the
/// border.
std::string whyNot(std::vector<glm::vec2>& coords, const std::vector<glm::uvec3>& triangles) {
  if (coords.empty()) return "is not there";
  for (glm::vec2& uv : coords) {
    const glm::vec2 inside = glm::clamp(uv, glm::vec2(0.0f), glm::vec2(1.0f));
    if (glm::any(glm::greaterThan(glm::abs(uv - inside), glm::vec2(borderSlack))))
      return fmt::format("goes outside 0..1, to ({:g}, {:g})", uv.x, uv.y);
    uv = inside;
  }
  if (uvArea(coords, triangles) < 1e-9) return "has no area";
  const auto center = [](int, int) { return glm::dvec2(0.5); };
  const UvRaster raster = rasterizeUv(coords, triangles, trialSize, trialSize, center);
  const double overlap = double(raster.overlapping) / double(std::max<std::size_t>(raster.covered, 1));
  if (overlap > mostOverlap)
    return fmt::format("uses {:.3g} % of its places more than once", 100.0 * overlap);
  return {};
}

double worldArea(const CompiledScene& compiled, const PrimitiveRange& range) {
  double sum = 0.0;
  for (std::uint32_t t = 0; t < range.triangleCount; ++t)
    sum += 0.5 * glm::length(geometricNormal(compiled, range.firstTriangle + t));
  return sum;
}

class ChartMaker {
 public:
  ChartMaker(const Scene& scene, const CompiledScene& compiled)
      : scene_(scene), compiled_(compiled), placed_(placePrimitives(scene)) {}

  Charts make(int size) {
    for (std::size_t p = 0; p < compiled_.primitives.size(); ++p) addChart(p);
    setSizes(size);
    if (!charts_.normalImages.empty()) charts_.tangents = cornerTangents(compiled_);
    return std::move(charts_);
  }

 private:
  void addChart(std::size_t index) {
    const PrimitiveRange& range = compiled_.primitives[index];
    const auto found = placed_.find({range.node, range.primitive});
    if (range.triangleCount == 0 || found == placed_.end()) return;
    const Primitive& primitive = *found->second;
    const std::vector<glm::uvec3> triangles = trianglesOf(compiled_, range);
    std::string reasons;
    for (const int set : {1, 0}) {
      Chart chart{index, set, 0, 0, set == 1 ? primitive.texCoords1 : primitive.texCoords0, {}};
      const std::string reason = whyNot(chart.coords, triangles);
      if (!reason.empty()) {
        reasons += fmt::format("{}TEXCOORD_{} {}", reasons.empty() ? "" : ", ", set, reason);
        continue;
      }
      chart.normalImage = normalImageOf(primitive);
      scales_.push_back(std::sqrt(worldArea(compiled_, range) / uvArea(chart.coords, triangles)));
      charts_.charts.push_back(std::move(chart));
      return;
    }
    if (range.instance == 0)
      charts_.leftOut.push_back(
          fmt::format("node \"{}\", primitive {}: {}", range.name, range.primitive, reasons));
  }

  std::optional<std::size_t> normalImageOf(const Primitive& primitive) {
    const int image = scene_.materialOf(primitive).normalTexture.image;
    if (image < 0) return std::nullopt;
    const auto [found, fresh] = imageAt_.try_emplace(image, charts_.normalImages.size());
    if (fresh) charts_.normalImages.push_back(scene_.images[static_cast<std::size_t>(image)]);
    return found->second;
  }

  void setSizes(int size) {
    std::map<std::pair<int, int>, double> scaleOf;  // greatest over all instances of a primitive
    double largest = 0.0;
    const auto keyOf = [&](const Chart& chart) {
      const PrimitiveRange& range = compiled_.primitives[chart.primitive];
      return std::pair(range.node, range.primitive);
    };
    for (std::size_t c = 0; c < scales_.size(); ++c) {
      double& scale = scaleOf[keyOf(charts_.charts[c])];
      scale = std::max(scale, scales_[c]);
      largest = std::max(largest, scale);
    }
    for (Chart& chart : charts_.charts) {
      const double side = std::ceil(size * scaleOf[keyOf(chart)] / largest - 1e-6);
      chart.width = chart.height = std::max(std::min(leastChartSize, size), static_cast<int>(side));
    }
  }

  const Scene& scene_;
  const CompiledScene& compiled_;
  PlacedPrimitives placed_;
  std::map<int, std::size_t> imageAt_;  ///< [index into Scene::images] index into Charts::normalImages
  std::vector<double> scales_;          ///< [chart], metres along a side of the unit square
  Charts charts_;
};

}  // namespace

std::vector<glm::uvec3> trianglesOf(const CompiledScene& scene, const PrimitiveRange& range) {
  std::vector<glm::uvec3> triangles;
  for (std::uint32_t t = 0; t < range.triangleCount; ++t)
    triangles.push_back(scene.triangles[range.firstTriangle + t] - glm::uvec3(range.firstVertex));
  return triangles;
}

std::string whyNoChart(std::vector<glm::vec2> coords, const std::vector<glm::uvec3>& triangles) {
  return whyNot(coords, triangles);
}

Charts makeCharts(const Scene& scene, const CompiledScene& compiled, int size) {
  return ChartMaker(scene, compiled).make(size);
}

std::optional<TextureFrame> normalTextureFrame(const CompiledScene& scene, const Charts& charts,
                                               const Chart& chart, std::uint32_t triangle,
                                               const glm::dvec3& weights, const glm::dvec3& normal) {
  if (!chart.normalImage) return std::nullopt;
  const CompiledMaterial& material = scene.materials[scene.triangleMaterials[triangle]];
  const TextureRef& use = material.normalTexture;
  const auto& coords = use.texCoord == 1 ? scene.texCoords1 : scene.texCoords;
  glm::dvec2 uv(0.0);
  glm::dvec3 tangent(0.0);
  for (int k = 0; k < 3; ++k) {
    uv += weights[k] * glm::dvec2(coords[scene.triangles[triangle][k]]);
    tangent +=
        weights[k] * glm::dvec3(charts.tangents[3 * std::size_t{triangle} + static_cast<std::size_t>(k)]);
  }
  const glm::dvec3 along = tangent - glm::dot(tangent, normal) * normal;
  const double length = glm::length(along);
  if (!(length > 1e-6)) return std::nullopt;
  const glm::dvec3 t = along / length;
  const double side = charts.tangents[3 * std::size_t{triangle}].w;
  return TextureFrame{glm::dvec2(glm::dmat3(use.transform) * glm::dvec3(uv, 1.0)), t,
                      side * glm::cross(normal, t)};
}

glm::dvec3 mappedNormal(const CompiledScene& scene, const Charts& charts, const Chart& chart,
                        std::uint32_t triangle, const glm::dvec3& weights, const glm::dvec3& normal) {
  const auto frame = normalTextureFrame(scene, charts, chart, triangle, weights, normal);
  if (!frame) return normal;
  const CompiledMaterial& material = scene.materials[scene.triangleMaterials[triangle]];
  const Image& image = charts.normalImages[*chart.normalImage];
  const glm::dvec3 texel =
      2.0 * glm::dvec3(sampleImage(image, material.normalTexture, glm::vec2(frame->place))) - 1.0;
  const glm::dvec3 mapped =
      double(material.normalScale) * (texel.x * frame->tangent + texel.y * frame->bitangent) +
      texel.z * normal;
  const double mappedLength = glm::length(mapped);
  return mappedLength > 1e-6 ? mapped / mappedLength : normal;
}

}  // namespace prelight

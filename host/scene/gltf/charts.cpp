#include "scene/gltf/charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scene/gltf/image_decode.h"
#include "scene/image_lookup.h"
#include "scene/uv_raster.h"

namespace prelight {

namespace {

constexpr float borderSlack = 1e-4f;   // coordinates that rounding put outside are moved to the border
constexpr int trialSize = 512;         // points a side that look for overlaps
constexpr double mostOverlap = 0.005;  // of the covered points

/// A primitive as the file has it and as it stands in the world.
struct Placed {
  const Primitive* primitive = nullptr;
  glm::dmat3 world{1.0};
};

using PlacedPrimitives = std::map<std::tuple<int, int, int>, Placed>;  ///< by node, primitive, instance

PlacedPrimitives placePrimitives(const Scene& scene) {
  PlacedPrimitives placed;
  for (const MeshNode& node : scene.meshNodes) {
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(node.mesh)];
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p)
      for (std::size_t i = 0; i < node.transforms.size(); ++i)
        placed[{node.node, static_cast<int>(p), static_cast<int>(i)}] = {&mesh.primitives[p],
                                                                         glm::dmat3(node.transforms[i])};
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

/// Why texture coordinates make no chart; empty when they do. Moves those just outside to the border.
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
  ChartMaker(const GltfDocument& document, const Scene& scene, const CompiledScene& compiled,
             Warnings& warnings)
      : document_(document),
        scene_(scene),
        compiled_(compiled),
        warnings_(warnings),
        placed_(placePrimitives(scene)) {}

  Charts make(int size) {
    for (std::size_t p = 0; p < compiled_.primitives.size(); ++p) addChart(p);
    setSizes(size);
    return std::move(charts_);
  }

 private:
  void addChart(std::size_t index) {
    const PrimitiveRange& range = compiled_.primitives[index];
    const auto found = placed_.find({range.node, range.primitive, range.instance});
    if (range.triangleCount == 0 || found == placed_.end()) return;
    const Primitive& primitive = *found->second.primitive;
    const std::vector<glm::uvec3> triangles = trianglesOf(compiled_, range);
    std::string reasons;
    for (const int set : {1, 0}) {
      Chart chart{index, set, 0, 0, set == 1 ? primitive.texCoords1 : primitive.texCoords0, {}};
      const std::string reason = whyNot(chart.coords, triangles);
      if (!reason.empty()) {
        reasons += fmt::format("{}TEXCOORD_{} {}", reasons.empty() ? "" : ", ", set, reason);
        continue;
      }
      chart.normalMap = normalMapOf(found->second);
      scales_.push_back(std::sqrt(worldArea(compiled_, range) / uvArea(chart.coords, triangles)));
      charts_.charts.push_back(std::move(chart));
      return;
    }
    if (range.instance == 0)
      charts_.leftOut.push_back(
          fmt::format("node \"{}\", primitive {}: {}", range.name, range.primitive, reasons));
  }

  std::optional<NormalMap> normalMapOf(const Placed& placed) {
    const Primitive& primitive = *placed.primitive;
    const Material& material = scene_.materialOf(primitive);
    const TextureRef& use = material.normalTexture;
    const auto& coords = use.texCoord == 1 ? primitive.texCoords1 : primitive.texCoords0;
    if (use.image < 0 || coords.empty()) return std::nullopt;
    const std::optional<std::size_t> image = imageOf(use.image);
    if (!image) return std::nullopt;
    NormalMap map{*image, use, material.normalScale, {}, {}};
    for (const glm::vec2& uv : coords) map.coords.emplace_back(use.transform * glm::vec3(uv, 1.0f));
    // A mirroring transform turns the bitangent around, which the cross product would not.
    const float mirror = glm::determinant(placed.world) < 0.0 ? -1.0f : 1.0f;
    for (const glm::vec4& tangent : primitive.tangents)
      map.tangents.emplace_back(glm::vec3(placed.world * glm::dvec3(tangent)), mirror * tangent.w);
    return map;
  }

  /// Into charts_.images; nothing when it cannot be read, which loadImage says.
  std::optional<std::size_t> imageOf(int image) {
    const auto [found, fresh] = imageAt_.try_emplace(image, std::nullopt);
    if (!fresh) return found->second;
    const std::size_t before = warnings_.size();
    Image loaded = loadImage(document_, static_cast<std::size_t>(image), warnings_);
    if (warnings_.size() > before) return std::nullopt;
    found->second = charts_.images.size();
    charts_.images.push_back(std::move(loaded));
    return found->second;
  }

  void setSizes(int size) {
    std::map<std::pair<int, int>, double> scaleOf;  // of all instances of a primitive
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

  const GltfDocument& document_;
  const Scene& scene_;
  const CompiledScene& compiled_;
  Warnings& warnings_;
  PlacedPrimitives placed_;
  std::map<int, std::optional<std::size_t>> imageAt_;  ///< by the file's number
  std::vector<double> scales_;                         ///< [chart], metres along a side of the unit square
  Charts charts_;
};

template <typename T>
T interpolate(const std::vector<T>& values, const glm::uvec3& corners, const glm::dvec3& weights) {
  return static_cast<float>(weights.x) * values[corners.x] +
         static_cast<float>(weights.y) * values[corners.y] +
         static_cast<float>(weights.z) * values[corners.z];
}

/// The direction in which u grows on a triangle, and w: +1 where n x t points to falling v, the texture's up.
glm::dvec4 tangentOfCoords(const CompiledScene& scene, std::uint32_t triangle,
                           const std::vector<glm::vec2>& coords, const glm::uvec3& corners,
                           const glm::dvec3& normal) {
  const glm::uvec3& t = scene.triangles[triangle];
  const glm::dvec3 p(scene.positions[t.x]), e1 = glm::dvec3(scene.positions[t.y]) - p,
                                            e2 = glm::dvec3(scene.positions[t.z]) - p;
  const glm::dvec2 a(coords[corners.x]), d1 = glm::dvec2(coords[corners.y]) - a,
                                         d2 = glm::dvec2(coords[corners.z]) - a;
  const double determinant = d1.x * d2.y - d2.x * d1.y;
  if (!(std::abs(determinant) > 0.0)) return glm::dvec4(0.0);
  const glm::dvec3 alongU = (d2.y * e1 - d1.y * e2) / determinant;
  const glm::dvec3 alongV = (d1.x * e2 - d2.x * e1) / determinant;
  return {alongU, glm::dot(glm::cross(normal, alongU), alongV) > 0.0 ? -1.0 : 1.0};
}

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

Charts makeCharts(const GltfDocument& document, const Scene& scene, const CompiledScene& compiled, int size,
                  Warnings& warnings) {
  return ChartMaker(document, scene, compiled, warnings).make(size);
}

glm::dvec3 mappedNormal(const CompiledScene& scene, const Charts& charts, const Chart& chart,
                        std::uint32_t triangle, const glm::dvec3& weights, const glm::dvec3& normal) {
  if (!chart.normalMap) return normal;
  const NormalMap& map = *chart.normalMap;
  const glm::uvec3 corners =
      scene.triangles[triangle] - glm::uvec3(scene.primitives[chart.primitive].firstVertex);
  const glm::vec2 uv = interpolate(map.coords, corners, weights);
  glm::dvec3 tangentSpace = 2.0 * glm::dvec3(sampleImage(charts.images[map.image], map.use, uv)) - 1.0;
  tangentSpace.x *= map.scale;
  tangentSpace.y *= map.scale;
  const glm::dvec4 tangent = map.tangents.empty()
                                 ? tangentOfCoords(scene, triangle, map.coords, corners, normal)
                                 : glm::dvec4(interpolate(map.tangents, corners, weights));
  const glm::dvec3 along = glm::dvec3(tangent) - glm::dot(glm::dvec3(tangent), normal) * normal;
  const double length = glm::length(along);
  if (!(length > 1e-9 * glm::length(glm::dvec3(tangent)))) return normal;
  const glm::dvec3 t = along / length;
  const glm::dvec3 b = (tangent.w < 0.0 ? -1.0 : 1.0) * glm::cross(normal, t);
  const glm::dvec3 mapped = tangentSpace.x * t + tangentSpace.y * b + tangentSpace.z * normal;
  const double mappedLength = glm::length(mapped);
  return mappedLength > 1e-6 ? mapped / mappedLength : normal;
}

}  // namespace prelight

#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// A primitive unfolded onto a rectangle of texels, of which each lies on one place of its surface at most.
/// Row 0 is at v = 0.
struct Chart {
  std::size_t primitive = 0;  ///< into CompiledScene::primitives
  int texCoord = 0;           ///< 0 or 1: TEXCOORD_n
  int width = 0;
  int height = 0;
  std::vector<glm::vec2> coords;           ///< [vertex of the primitive], in [0,1]^2
  std::optional<std::size_t> normalImage;  ///< of its normal texture, into Charts::normalImages
};

struct Charts {
  std::vector<Chart> charts;  ///< in the order of the primitives
  std::vector<Image> normalImages = {};
  std::vector<std::string> leftOut = {};  ///< primitives without a chart, and why
  std::vector<glm::vec4> tangents =
      {};  ///< cornerTangents() of the scene, where a chart has a normal texture
};

/// Charts of all primitives that have texture coordinates for one: TEXCOORD_1, or else TEXCOORD_0, within the
/// unit square and without overlaps. The one whose square is largest in the world gets `size` x `size`
/// texels, the others as many as make texels about as large, at least leastChartSize; instances of a
/// primitive get the same.
Charts makeCharts(const Scene& scene, const CompiledScene& compiled, int size);

constexpr int leastChartSize = 4;

/// Why texture coordinates make no chart, as "is not there"; empty when they do.
std::string whyNoChart(std::vector<glm::vec2> coords, const std::vector<glm::uvec3>& triangles);

/// Triangles of a primitive, of its own vertices.
std::vector<glm::uvec3> trianglesOf(const CompiledScene& scene, const PrimitiveRange& range);

/// How a chart's normal texture lies at a point of the surface.
struct TextureFrame {
  glm::dvec2 place;               ///< coordinates of the texture
  glm::dvec3 tangent, bitangent;  ///< unit, across the normal
};

/// At barycentric weights of one of the scene's triangles, whose unit shading normal is `normal` there; none:
/// no texture, or none that has a direction there.
std::optional<TextureFrame> normalTextureFrame(const CompiledScene& scene, const Charts& charts,
                                               const Chart& chart, std::uint32_t triangle,
                                               const glm::dvec3& weights, const glm::dvec3& normal);

/// Unit normal of a chart's surface at barycentric weights of one of the scene's triangles: the normal
/// texture's around `normal`, the unit shading normal, or that itself where there is none.
glm::dvec3 mappedNormal(const CompiledScene& scene, const Charts& charts, const Chart& chart,
                        std::uint32_t triangle, const glm::dvec3& weights, const glm::dvec3& normal);

}  // namespace prelight

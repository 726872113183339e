#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// A primitive unfolded onto a rectangle of texels, each of which lies on at most one place of its surface.
/// Row 0 is at v = 0.
struct Chart {
  std::size_t primitive = 0;  ///< index into CompiledScene::primitives
  int texCoord = 0;           ///< 0 or 1: TEXCOORD_n
  int width = 0;
  int height = 0;
  std::vector<glm::vec2> coords;           ///< [vertex of the primitive], in [0,1]^2
  std::optional<std::size_t> normalImage;  ///< index of its normal texture in Charts::normalImages
};

/// The charts of a scene.
struct Charts {
  std::vector<Chart> charts;  ///< in the order of the primitives
  std::vector<Image> normalImages = {};
  std::vector<std::string> leftOut = {};  ///< primitives without a chart, and why
  std::vector<glm::vec4> tangents =
      {};  ///< cornerTangents() of the scene, where a chart has a normal texture
};

/// Makes charts of all primitives with suitable texture coordinates: TEXCOORD_1, or else TEXCOORD_0, within
/// the unit square and without overlaps. The chart whose square is largest in the world gets `size` x `size`
/// texels; the others get as many as make their texels about as large, at least leastChartSize. Instances of
/// a primitive get the same size.
Charts makeCharts(const Scene& scene, const CompiledScene& compiled, int size);

constexpr int leastChartSize = 4;

/// Returns why texture coordinates make no chart, such as "is not there"; empty when they do.
std::string whyNoChart(std::vector<glm::vec2> coords, const std::vector<glm::uvec3>& triangles);

/// Returns the triangles of a primitive as indices of its own vertices.
std::vector<glm::uvec3> trianglesOf(const CompiledScene& scene, const PrimitiveRange& range);

/// The placement of a chart's normal texture at a point of the surface.
struct TextureFrame {
  glm::dvec2 place;               ///< coordinates of the texture
  glm::dvec3 tangent, bitangent;  ///< unit, perpendicular to the normal
};

/// Returns the frame at barycentric weights of one of the scene's triangles, whose unit shading normal is
/// `normal` there; none if there is no texture, or its coordinates have no direction there.
std::optional<TextureFrame> normalTextureFrame(const CompiledScene& scene, const Charts& charts,
                                               const Chart& chart, std::uint32_t triangle,
                                               const glm::dvec3& weights, const glm::dvec3& normal);

/// Returns the unit normal of a chart's surface at barycentric weights of one of the scene's triangles:
/// `normal`, the unit shading normal, as the normal texture turns it, or unchanged without one.
glm::dvec3 mappedNormal(const CompiledScene& scene, const Charts& charts, const Chart& chart,
                        std::uint32_t triangle, const glm::dvec3& weights, const glm::dvec3& normal);

}  // namespace prelight

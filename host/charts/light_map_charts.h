#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "scene/surface_regions.h"

namespace prelight {

/// A piece of a primitive's surface laid flat.
struct LightMapChart {
  bool back = false;                     ///< the backs of its triangles
  bool fromFile = false;                 ///< laid out by the file's TEXCOORD_1
  std::vector<std::uint32_t> triangles;  ///< of the scene
  std::vector<glm::vec2> corners;        ///< [triangle][3], m, within [0, size]
  glm::dvec2 size{0.0};                  ///< m, width >= height
};

struct LightMapCharts {
  std::vector<LightMapChart> charts;
  double area = 0.0;       ///< of all of them, m2
  double texelSize = 0.0;  ///< m, asked for or chosen
};

constexpr int mostLightMapSide = 4096;    ///< texels
constexpr double leastChartAcross = 0.5;  ///< texels; a chart of less is one texel

struct LightMapLayoutRequest {
  double texelSize = 0.0;  ///< m; 0: such that there are about `texels`
  /// A gather of 1000 rays a texel takes PoCL on a small CPU some ten seconds for these, and a room of 35 m2
  /// gets texels of 2.3 cm.
  std::uint32_t texels = 1u << 16;
  double creaseAngle = usualCreaseAngle;
  bool wideMetals = false;  ///< charts of metals, too, whose lobes are wide: isWideMetal()
};

/// Charts of all surfaces that reflect diffusely, and of others that are asked for: the islands of TEXCOORD_1
/// where a primitive has one without overlaps and with little stretch, or else its regions
/// (scene/surface_regions.h), cut where they do not lie flat. A chart belongs to one primitive of one node
/// and instance. Backs of double-sided and of translucent materials have charts of their own, of the shapes
/// of the fronts. Pieces of less than a texel join what is next to them where a plane serves both.
LightMapCharts makeLightMapCharts(const Scene& scene, const CompiledScene& compiled,
                                  const LightMapLayoutRequest& request);

/// The area of a chart laid flat, m2.
double flatArea(const LightMapChart& chart);

/// Whether a surface reflects light diffusely, or lets it through, that arrives at a side of a triangle.
bool hasLight(const CompiledMaterial& material, bool back);

/// Reflects by nothing but lobes that are so wide that rasterised pictures show the mean of what arrives.
bool isWideMetal(const CompiledMaterial& material);

}  // namespace prelight

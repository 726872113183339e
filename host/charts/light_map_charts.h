#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "scene/surface_regions.h"

namespace prelight {

/// A flattened piece of a primitive's surface.
struct LightMapChart {
  bool back = false;                     ///< the chart is of the backs of its triangles
  bool fromFile = false;                 ///< laid out by the file's TEXCOORD_1
  std::vector<std::uint32_t> triangles;  ///< triangles of the scene
  std::vector<glm::vec2> corners;        ///< [triangle][3], m, within [0, size]
  glm::dvec2 size{0.0};                  ///< m, width >= height
};

/// A primitive whose TEXCOORD_1 is not used.
struct ReplacedCoords {
  std::string name;    ///< name of its node
  std::string reason;  ///< such as "goes outside 0..1, to (1.02, 1)"
};

/// The charts of a scene's light map, before they are laid out.
struct LightMapCharts {
  std::vector<LightMapChart> charts;
  double area = 0.0;       ///< sum over all charts, m2
  double texelSize = 0.0;  ///< m, requested or chosen
  std::vector<ReplacedCoords> replaced = {};
};

constexpr int mostLightMapSide = 4096;    ///< texels
constexpr double leastChartAcross = 0.5;  ///< texels; a smaller chart becomes one texel

/// Requested size and contents of a light map.
struct LightMapLayoutRequest {
  double texelSize = 0.0;    ///< m; 0: chosen such that there are about `texels`
  std::uint32_t texels = 0;  ///< 0: the usual number for the scene (charts/usual_texels.h)
  double creaseAngle = usualCreaseAngle;
  bool wideMetals = false;  ///< also makes charts of metals with wide lobes: isWideMetal()
};

/// Makes charts of all surfaces that reflect diffusely, and of others that are requested: a primitive's
/// regions (scene/surface_regions.h), cut where they are not flat, or the islands of its TEXCOORD_1, where
/// these have no overlaps, little stretch and hardly more cuts. A chart belongs to one primitive of one node
/// and instance. Backs of double-sided and of translucent materials have separate charts of the same shapes
/// as the fronts. Pieces of less than a texel join neighbours where one plane fits both.
LightMapCharts makeLightMapCharts(const Scene& scene, const CompiledScene& compiled,
                                  const LightMapLayoutRequest& request);

/// Returns the area of a flattened chart, m2.
double flatArea(const LightMapChart& chart);

/// Returns true when a surface reflects or transmits light diffusely that arrives at a side of a triangle.
bool hasLight(const CompiledMaterial& material, bool back);

/// Returns true when a material reflects only by lobes so wide that rasterised pictures show the mean of the
/// arriving light.
bool isWideMetal(const CompiledMaterial& material);

}  // namespace prelight

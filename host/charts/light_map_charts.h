#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "prelight/scene.h"
#include "scene/surface/surface_regions.h"

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
  std::uint32_t texels = 0;  ///< 0: the usual number for the scene (charts/light_map_charts.h)
  double creaseAngle = usualCreaseAngle;
  bool wideMetals = false;  ///< also makes charts of metals with wide lobes: isWideMetal()
};

/// Makes charts of all surfaces that reflect diffusely, and of others that are requested: a primitive's
/// regions (scene/surface/surface_regions.h), cut where they are not flat, or the islands of its TEXCOORD_1,
/// where these have no overlaps, little stretch and hardly more cuts. A chart belongs to one primitive of one
/// node and instance. Backs of double-sided and of translucent materials have separate charts of the same
/// shapes as the fronts. Pieces of less than a texel join neighbours where one plane fits both.
LightMapCharts makeLightMapCharts(const Scene& scene, const CompiledScene& compiled,
                                  const LightMapLayoutRequest& request);

/// Returns the area of a flattened chart, m2.
double flatArea(const LightMapChart& chart);

/// Returns true when a surface reflects or transmits light diffusely that arrives at a side of a triangle.
bool hasLight(const CompiledMaterial& material, bool back);

/// Returns true when a material reflects only by lobes so wide that rasterised pictures show the mean of the
/// arriving light.
bool isWideMetal(const CompiledMaterial& material);

/// Fewest texels of a light map whose texel size or number is not specified: a room of 35 m2 gets texels of
/// 2.3 cm.
constexpr std::uint32_t fewestUsualTexels = std::uint32_t{1} << 16;
constexpr std::uint32_t mostUsualTexels = std::uint32_t{1} << 20;

/// The texels of a scene's light map if neither size nor number is specified.
struct UsualTexels {
  std::uint32_t count = fewestUsualTexels;  ///< approximate
  double area = 0.0;                        ///< lit area, of both sides where both are lit, m2
};

/// Chooses the number of texels: few blur the light of small pieces of surface, many take long. Light is
/// assumed to vary over each piece about equally, whatever its size, so that the squared error of a piece is
/// 1 / its number of texels, at most 1. The sum of the mean error over the area and a price per texel is
/// minimised. Where no piece is smaller than a texel, the count grows with the root of the number of pieces.
/// `regions`: of the scene, by the usual crease angle.
UsualTexels usualTexels(const CompiledScene& scene, const SurfaceRegions& regions);
UsualTexels usualTexels(const CompiledScene& scene);

/// Adds charts of the backs of one-sided surfaces to the layout of `charts`: for every chart with a triangle
/// that `met`, [triangle] or empty, marks. They have the shapes and texels of the fronts and lie in rows of
/// their own below the existing ones, which are unchanged. Returns the number of charts added. Throws as
/// layOutLightMap().
std::uint32_t addBacks(const CompiledScene& scene, const LightMapCharts& charts,
                       std::span<const std::uint8_t> met, LightMapLayout& layout);

}  // namespace prelight

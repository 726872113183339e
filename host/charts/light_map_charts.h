#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
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

/// A primitive whose TEXCOORD_1 is not used.
struct ReplacedCoords {
  std::string name;    ///< of its node
  std::string reason;  ///< such as "goes outside 0..1, to (1.02, 1)"
};

struct LightMapCharts {
  std::vector<LightMapChart> charts;
  double area = 0.0;       ///< of all of them, m2
  double texelSize = 0.0;  ///< m, asked for or chosen
  std::vector<ReplacedCoords> replaced = {};
};

constexpr int mostLightMapSide = 4096;    ///< texels
constexpr double leastChartAcross = 0.5;  ///< texels; a chart of less is one texel

struct LightMapLayoutRequest {
  double texelSize = 0.0;    ///< m; 0: such that there are about `texels`
  std::uint32_t texels = 0;  ///< 0: as many as are usual for the scene (charts/usual_texels.h)
  double creaseAngle = usualCreaseAngle;
  bool wideMetals = false;  ///< charts of metals, too, whose lobes are wide: isWideMetal()
};

/// Charts of all surfaces that reflect diffusely, and of others that are asked for: a primitive's regions
/// (scene/surface_regions.h), cut where they do not lie flat, or the islands of its TEXCOORD_1, where these
/// have no overlaps, little stretch and hardly more cuts. A chart belongs to one primitive of one node
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

#pragma once

#include <span>
#include <string>
#include <vector>

#include "basis/median_cut.h"
#include "plot/drawing.h"
#include "prelight/picture.h"

/// Pictures of skies.
namespace prelight::plot {

constexpr int mapWidth = 640, mapHeight = 320;  ///< pixels of a map of the sphere

/// A sky of a row of a plot.
struct SkyRow {
  std::string caption;
  std::vector<glm::vec3> radiance;  ///< of directionsOfMap(), may be negative
  double error = 0.0;               ///< relative to the sky itself: root of the ratio of sums of squares
};

/// Returns the directions of the texels of the maps, which are equirectangular.
std::vector<glm::dvec3> directionsOfMap();

/// Returns the sky itself.
SkyRow skyItself(const Environment& sky);

/// Returns the sky in SH of an order.
SkyRow skyInHarmonics(const Environment& sky, int order);

/// Returns the sky on a cube of Haar wavelets, of which as many coefficients are kept as count most.
SkyRow skyInWavelets(const Environment& sky, int faceSize, std::size_t terms);

/// Returns skies below one another, exposed alike. Negative radiance is violet.
Drawing plotSkies(std::span<const SkyRow> rows);

/// Returns the lights that stand for a sky as circles over its map. The area of a circle grows with the
/// light's irradiance.
Drawing plotSkyLights(const Environment& sky, std::span<const SkyLight> lights);

}  // namespace prelight::plot

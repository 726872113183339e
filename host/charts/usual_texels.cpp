#include "charts/usual_texels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "charts/light_map_charts.h"

namespace prelight {

namespace {

/// Price of the square of the texel count, in squared error, such that scenes of up to some sixty pieces have
/// the fewest texels. A price of the count itself would leave so few rays per texel that noise exceeds the
/// gain.
constexpr double piecesOfFewest = 60.0;
constexpr double price = 0.5 * piecesOfFewest /
                         (double(fewestUsualTexels) * double(fewestUsualTexels) * double(fewestUsualTexels));
constexpr int stepsPerOctave = 8;  // step of the counts that are tried

/// Returns the lit areas, m2, of a scene's pieces: regions, or primitives' parts of them; both sides where
/// both are lit.
std::vector<double> areasOfPieces(const CompiledScene& scene, const SurfaceRegions& regions) {
  const SurfaceRegions parts = splitByPrimitive(regions, scene);
  std::vector<double> areas(parts.count(), 0.0);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const CompiledMaterial& material = scene.materials[scene.triangleMaterials[t]];
    const double area = 0.5 * glm::length(geometricNormal(scene, t));
    for (const bool back : {false, true})
      if (hasLight(material, back)) areas[parts.regionOf[t]] += area;
  }
  return areas;
}

/// Returns the mean squared error with `count` texels. Pieces that are smaller than a texel have an error of
/// 1.
double squaredError(const std::vector<double>& areas, double area, double count) {
  const double texel = area / count;
  double sum = 0.0;
  for (const double piece : areas) sum += std::min(piece, texel);
  return sum / area;
}

}  // namespace

UsualTexels usualTexels(const CompiledScene& scene, const SurfaceRegions& regions) {
  const std::vector<double> pieces = areasOfPieces(scene, regions);
  UsualTexels result;
  for (const double area : pieces) result.area += area;
  if (!(result.area > 0.0)) return result;
  double least = std::numeric_limits<double>::max();
  for (int step = 0;; ++step) {
    const double count = std::round(fewestUsualTexels * std::exp2(double(step) / stepsPerOctave));
    if (count > mostUsualTexels) return result;
    const double cost = squaredError(pieces, result.area, count) + price * count * count;
    if (cost >= least) continue;
    least = cost;
    result.count = static_cast<std::uint32_t>(count);
  }
}

UsualTexels usualTexels(const CompiledScene& scene) {
  return usualTexels(scene, makeSurfaceRegions(scene, usualCreaseAngle));
}

}  // namespace prelight

#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "benchmarks/suites/indirect/indirect_suite.h"
#include "photon/density_estimator.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/progress.h"
#include "scene/surface/surface_regions.h"
#include "shared/density_types.h"
#include "shared/photon_types.h"

/// Made-up photons, whose light is known exactly.
namespace prelight::benchmarks {

/// Returns separate unit squares in the plane y = 0, facing up, 2 m apart, each a region. Square i consists
/// of triangles 2 i and 2 i + 1.
CompiledScene makeSquares(std::size_t count);

/// Returns one region of the whole scene, for a single photon map.
SurfaceRegions wholeRegion(const CompiledScene& scene);

device::Photon makePhoton(const glm::dvec3& position, std::uint32_t triangle, double power);

/// Returns photons spread through the unit cube and assigned in turn to the fronts of `squares` squares, to
/// measure trees of photons that lie anywhere.
std::vector<device::Photon> photonsInCube(std::size_t count, std::size_t squares, std::mt19937& random);

/// Returns photons on the square of makeSquares(1): all spread evenly, or half of them in a spot whose
/// standard deviation is a fiftieth of the square.
std::vector<device::Photon> photonsOnSquare(std::size_t count, bool spot, std::mt19937& random);

/// Returns photons spread evenly over the fronts of all triangles.
std::vector<device::Photon> photonsOnScene(const CompiledScene& scene, std::size_t count,
                                           std::mt19937& random);

/// Returns about `count` queries, from above, at the positions of evenly chosen photons.
std::vector<device::DensityQuery> queriesAtPhotons(std::span<const device::Photon> photons, std::size_t count,
                                                   double radius);

/// The caustic of parallel light on the floor of a cylinder that is mirrored inside: a nephroid, in closed
/// form. The cylinder has radius 0.5 m around the middle of the square of makeSquares(1). Light travels
/// towards +x and down. Light that the wall reflects at angle a lands a horizontal distance s further,
/// uniformly up to the opposite wall.
class MirroredCylinder {
 public:
  /// Returns photons of together 1 W.
  static std::vector<device::Photon> photons(std::size_t count, std::mt19937& random);

  /// Returns the irradiance at (x, z) by 1 W, W/m2; infinite on the caustic itself.
  static double irradiance(double x, double z);
};

/// Measures error and processor time of filters of a caustic in closed form by the number of photons:
/// "caustic/100k/k 50". relMSE is over the pixels of a picture of the floor, compared with the mean
/// irradiance of each pixel.
void measureCaustic(const Device& device, const IndirectOptions& options,
                    std::vector<BenchmarkResult>& results);

}  // namespace prelight::benchmarks

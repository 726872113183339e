#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "photon/density_estimator.h"
#include "prelight/compiled_scene.h"
#include "scene/surface_regions.h"
#include "shared/density_types.h"
#include "shared/photon_types.h"

/// Photons of which more is known than of traced ones.
namespace prelight::benchmarks {

/// Separate unit squares in the plane y = 0, facing up, 2 m apart: a region each; square i is triangles 2 i
/// and 2 i + 1.
CompiledScene makeSquares(std::size_t count);

/// One region of everything, as if there were one photon map.
SurfaceRegions wholeRegion(const CompiledScene& scene);

device::Photon makePhoton(const glm::dvec3& position, std::uint32_t triangle, double power);

/// Photons spread through the unit cube, dealt to the fronts of `squares` squares in turn: what a tree costs
/// where photons lie anywhere.
std::vector<device::Photon> photonsInCube(std::size_t count, std::size_t squares, std::mt19937& random);

/// Photons on the one square of makeSquares(1): all spread evenly, or half of them in a spot whose standard
/// deviation is a fiftieth of the square.
std::vector<device::Photon> photonsOnSquare(std::size_t count, bool spot, std::mt19937& random);

/// Photons spread evenly over the fronts of all triangles.
std::vector<device::Photon> photonsOnScene(const CompiledScene& scene, std::size_t count,
                                           std::mt19937& random);

/// Queries at every so many photons, from above.
std::vector<device::DensityQuery> queriesAtPhotons(std::span<const device::Photon> photons, std::size_t count,
                                                   double radius);

}  // namespace prelight::benchmarks

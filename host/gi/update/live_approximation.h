#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gi/irradiance_map.h"
#include "gi/surface_patches.h"
#include "gi/update/live_photons.h"
#include "photon/density_estimator.h"
#include "prelight/light_map.h"

namespace prelight {

/// How much the light on a region of the surface has changed.
struct RegionChange {
  std::uint32_t region = 0;
  double irradiance = 0.0;  ///< mean of the differences over its texels, luminance, W/m2
};

struct ApproximationFrame {
  std::uint32_t surfaces = 0;  ///< sides of regions that were estimated
  std::uint32_t texels = 0;
  std::vector<RegionChange> changes;
};

/// The approximated illumination that is gathered from (Larsen 2004, ch. 10): irradiance by the density of
/// photons at the texels of a light map, estimated again where photons came or went, the surface of the
/// greatest change first.
class LiveApproximation {
 public:
  /// The layout's walls must not be of what moves. The arguments but the layout outlive it; the scene is the
  /// one that the tracer was made of. `nearest`: photons of an estimate.
  LiveApproximation(const CompiledScene& scene, Tracer& tracer, const LightMapLayout& layout,
                    const SurfaceRegions& regions, int nearest, const Device& device);

  /// Takes the regions of triangles to where these are now.
  void follow(std::span<const std::uint32_t> triangles);

  void photonsChanged(const PhotonDelta& delta);

  /// Estimates texels of the surfaces that changed most in power over area, about `texels` of them; 0: all
  /// that wait. `photons`: all that are stored.
  ApproximationFrame advance(std::span<const device::Photon> photons, std::uint32_t texels);

  bool settled() const;
  double meanIrradiance() const;  ///< over the texels, luminance, W/m2
  const IrradianceMap& map() const { return map_; }

 private:
  /// A side of a patch.
  struct Surface {
    std::vector<std::uint32_t> places;  ///< of the layout's texels
    double area = 0.0;
    double power = 0.0;         ///< that came or went since it was last estimated, W
    std::size_t next = 0;       ///< place to estimate
    std::size_t remaining = 0;  ///< places that wait
  };

  std::vector<std::uint32_t> choose(std::uint32_t texels);
  static std::vector<std::uint32_t> takePlaces(Surface& surface, std::size_t most);
  std::vector<double> estimate(std::span<const std::uint32_t> places);

  const CompiledScene& scene_;
  std::vector<LightMapTexel> places_;
  double radius_;  ///< of estimates at most, m
  DensitySurface surface_;
  SurfacePatches patches_;
  DensityEstimator estimator_;
  std::vector<Surface> surfaces_;       ///< [patch][front, back]
  std::vector<std::uint32_t> patchOf_;  ///< [place]
  std::vector<glm::vec3> values_, grid_;
  IrradianceMap map_;
};

}  // namespace prelight

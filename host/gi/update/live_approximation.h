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

/// Change of the light on a region of the surface.
struct RegionChange {
  std::uint32_t region = 0;
  double irradiance = 0.0;  ///< mean absolute difference over its texels, luminance, W/m2
};

/// Work of one frame.
struct ApproximationFrame {
  std::uint32_t surfaces = 0;  ///< sides of patches whose texels were estimated
  std::uint32_t texels = 0;
  std::vector<RegionChange> changes;
};

/// The approximate illumination that final gathering looks up (Larsen 2004, ch. 10): irradiance from photon
/// densities at the texels of a light map. Texels are estimated again where photons came or went, on the
/// surface with the greatest change first.
class LiveApproximation {
 public:
  /// The layout's walls must not belong to moving objects. All arguments but the layout must outlive the
  /// object, and the tracer must be made of the scene. `nearest` is the number of photons per estimate.
  LiveApproximation(const CompiledScene& scene, Tracer& tracer, const LightMapLayout& layout,
                    const SurfaceRegions& regions, int nearest, const Device& device);

  /// Updates the regions of triangles that have moved.
  void follow(std::span<const std::uint32_t> triangles);

  void photonsChanged(const PhotonDelta& delta);

  /// Estimates about `texels` texels on the surfaces with the greatest change of power per area; 0: all that
  /// wait. `photons` are all stored photons.
  ApproximationFrame advance(std::span<const device::Photon> photons, std::uint32_t texels);

  bool settled() const;
  double meanIrradiance() const;  ///< over the texels, luminance, W/m2
  const IrradianceMap& map() const { return map_; }
  std::span<const glm::vec3> irradiance() const { return values_; }  ///< W/m2, [place of the layout's texels]

 private:
  /// One side of a patch.
  struct Surface {
    std::vector<std::uint32_t> places;  ///< indices into the layout's texels
    double area = 0.0;
    double power = 0.0;         ///< power that came or went since the last estimate, W
    std::size_t next = 0;       ///< place to estimate next
    std::size_t remaining = 0;  ///< number of places that wait
  };

  std::vector<std::uint32_t> choose(std::uint32_t texels);
  void sortPhotons(std::span<const device::Photon> photons);
  static std::vector<std::uint32_t> takePlaces(Surface& surface, std::size_t most);
  std::vector<double> estimate(std::span<const std::uint32_t> places);

  const CompiledScene& scene_;
  std::vector<LightMapTexel> places_;
  double radius_;  ///< largest radius of estimates, m
  DensitySurface surface_;
  SurfacePatches patches_;
  DensityEstimator estimator_;
  std::vector<Surface> surfaces_;       ///< [patch][front, back]
  std::vector<std::uint32_t> patchOf_;  ///< [place]
  bool photonsAreOld_ = true;           ///< whether photons have come or gone since the estimator got them
  std::vector<glm::vec3> values_, grid_;
  std::vector<float> shares_;  ///< [place], sharesOfRegions()
  IrradianceMap map_;
};

}  // namespace prelight

#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "charts/light_map_lookup.h"
#include "gi/final_gather.h"
#include "gi/update/live_approximation.h"
#include "gi/update/live_photons.h"
#include "gi/update/live_scene.h"
#include "prelight/light_map.h"
#include "scene/surface/surface_regions.h"

namespace prelight {

/// Predicts a value from an exact one of earlier and two coarse ones, of then and now: by their difference
/// where light grows and by their ratio where it shrinks. The result is never negative, and it is the exact
/// value if the coarse ones are equal.
glm::vec3 followed(const glm::vec3& exact, const glm::vec3& then, const glm::vec3& now);

/// Options of CoarseLight.
struct CoarseLightOptions {
  LivePhotonOptions photons;
  int nearestPhotons = 20;       ///< per estimate
  std::uint32_t rays = 64;       ///< per texel while light changes, a power of two, 8 to 256
  std::uint32_t fineRays = 128;  ///< per texel from a fine approximation, a power of two, 8 to 256
  std::uint64_t seed = 0;
};

/// Indirect light by few photons at few texels of a coarse light map, as a fine light map's texels see it. It
/// is computed anew in every frame with a change, and its changes are added to what refine() has gathered
/// from the approximation of all photons.
class CoarseLight {
 public:
  /// Computes the light. All arguments but the layouts and options must outlive the object; `fine` are the
  /// texels for which light is interpolated.
  CoarseLight(const LiveScene& scene, TransportScene& transport, const LightMapLayout& layout,
              const LightMapLayout& fine, const SurfaceRegions& regions, const IrradianceMap& approximation,
              const CoarseLightOptions& options, const Device& device, Progress& progress);

  /// Registers a change that the transport scene has followed.
  void changed(const SceneChange& change);

  /// Computes the light anew if something has changed. Returns the number of rays of final gathering.
  std::uint64_t advance(Progress& progress);

  /// Gathers from the fine approximation, which has settled. Returns the number of rays.
  std::uint64_t refine(Progress& progress);

  /// Returns whether neither advance() nor refine() has something to do.
  bool settled() const { return !changed_ && !unrefined_; }

  /// Returns irradiance, W/m2, [place of the fine layout's texels].
  std::span<const glm::vec3> light() const { return light_; }

 private:
  std::vector<glm::vec3> gather(FinalGather& gatherer, std::uint32_t rays, Progress& progress);
  void interpolate();

  const CompiledScene& scene_;
  LightMapLayout layout_;
  CoarseLightOptions options_;
  LivePhotons photons_;
  LiveApproximation approximation_;
  FinalGather coarseGather_, fineGather_;
  std::vector<LightMapLookUp> lookUps_;  ///< [place of the fine layout], into places of the coarse one
  std::vector<glm::vec3> refined_, then_, now_;  ///< [place of the coarse layout]
  std::vector<glm::vec3> light_;
  bool changed_ = false, unrefined_ = false;
};

}  // namespace prelight

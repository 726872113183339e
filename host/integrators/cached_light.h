#pragma once

#include <cstdint>
#include <memory>

#include "gi/irradiance_map.h"
#include "gpu/transport_scene.h"
#include "integrators/reference.h"
#include "photon/caustic_light.h"
#include "photon/density_estimator.h"
#include "photon/density_surface.h"
#include "photon/photon_tracer.h"
#include "shared/cached_light_types.h"

namespace prelight::reference {

/// Precomputed light that camera paths look up at surfaces instead of continuing. The referents must outlive
/// it.
struct CachedLight {
  const IrradianceMap* indirect = nullptr;  ///< everything but direct light and caustics
  const CausticLight* caustics = nullptr;   ///< nullptr: none
  /// Whether diffuse rays also look for lights; near lights, light sampling alone has no bound.
  bool meetsLights = false;
};

/// Returns the options of integrate/cached_path_kernels.cl, added to those of the paths.
BuildOptions cachedLightOptions(const CachedLight& light, BuildOptions options);

/// Sets all parameters but those of the paths. `samples` is the number of paths per pixel.
void setCachedLight(const CachedLight& light, std::uint32_t samples,
                    device::CachedPathParameters& parameters);

/// Photons of punctual lights that mirrors and smooth glass have scattered onto other surfaces, a new set in
/// each pass. Camera paths cannot hit such lights and look up these photons instead. Their radius shrinks
/// from pass to pass (Knaus and Zwicker 2011), so that noise and blur of the mean of all passes decrease
/// together.
class CausticPasses {
 public:
  /// Returns whether a request needs such photons for a scene.
  static bool areNeeded(const TransportScene& scene, const CompiledScene& compiled,
                        const ReferenceRequest& request);

  /// Sends the photons of a pilot pass. All arguments must outlive the object. `pathsPerPass` counts those of
  /// a whole picture.
  CausticPasses(TransportScene& scene, const CompiledScene& compiled, const ReferenceRequest& request,
                std::uint64_t pathsPerPass);

  /// Returns whether a photon of the pilot pass has landed.
  bool any() const { return firstRadius_ > 0.0; }

  /// Makes the photons of a pass.
  void make(std::uint64_t pass);

  float radius() const { return radius_; }  ///< m
  const Buffer<device::DensityParameters>& parameters() const { return parameters_; }
  const Buffer<device::DensityLine>& lines() const { return estimator_.lines(); }
  std::uint64_t rays() const { return rays_; }  ///< rays of all photons so far

 private:
  PhotonHits send(std::uint64_t seed, std::uint64_t photons);

  const CompiledScene& compiled_;
  TransportScene& scene_;
  ReferenceRequest request_;
  std::uint64_t photons_;
  PhotonTracer tracer_;
  DensitySurface surface_;
  DensityEstimator estimator_;
  Buffer<device::DensityParameters> parameters_;
  double firstRadius_ = 0.0;  ///< m
  float radius_ = 0.0f;
  std::uint64_t rays_ = 0;
};

}  // namespace prelight::reference

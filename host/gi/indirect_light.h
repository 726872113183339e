#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "basis/incident_values.h"
#include "gi/final_gather.h"
#include "gi/gather_receivers.h"
#include "gi/irradiance_cache.h"
#include "gi/irradiance_map.h"
#include "gi/surface_patches.h"
#include "gpu/transport_scene.h"
#include "photon/density_estimator.h"
#include "photon/density_surface.h"
#include "photon/sent_photons.h"
#include "prelight/light_map.h"
#include "prelight/progress.h"

namespace prelight {

/// How indirect light at texels is found from what they see.
enum class GatherChoice : std::uint8_t {
  All,     ///< rays from every texel, spread by their cosine
  Cache,   ///< at some texels, and interpolated along gradients between them (gi/irradiance_cache.h)
  Guided,  ///< rays from every texel, half of them where photons came from (gi/guided_gather.h)
};

struct IndirectRequest {
  std::uint64_t photons = 50000;  ///< that leave lights, for the approximation that is gathered from
  int nearestPhotons = 15;        ///< of an estimate, at least leastNearestOfAll where photons tell all light
  std::uint32_t rays = 128;       ///< a place, a power of two from 8 on
  std::uint64_t seed = 0;
  std::uint32_t longWay = GatherRequest{}.longWay;  ///< as GatherRequest
  /// Light that reaches the texels that are gathered from straight from its source is found by shadow rays,
  /// so that shadows stay dark; true: by photons like the rest, which blur them (Larsen 2004, ch. 10).
  bool directByPhotons = false;
  GatherChoice gather = GatherChoice::All;
  double cacheError = IrradianceCacheOptions{}.error;  ///< of the cache
  std::uint64_t gatherSeed = 0;  ///< other rays, from the same photons and approximation
};

/// Photons of an estimate of all light. Those straight from a light lie so evenly that fewer tell too little.
constexpr int leastNearestOfAll = 40;

/// The photons of a request, for sendPhotons().
PhotonRequest indirectPhotons(const TransportScene& scene, const IndirectRequest& request);

/// What a receiver asks for; a place has several where it has more rays than a receiver may have.
GatherRequest gatherRequest(const IndirectRequest& request);

/// Indirect light at places of the surface: everything but direct light and caustics. A final gathering from
/// what photons left in the texels of a light map (Larsen 2004, ch. 11, over the whole hemisphere).
class IndirectLight {
 public:
  /// `lit` is what `scene` is made of; `patches`: of the light map that is gathered from; `photons`:
  /// indirectPhotons() of the request, sent. Scene, patches and device outlive it. Throws Interrupted.
  IndirectLight(const LitScene& lit, TransportScene& scene, const SurfacePatches& patches,
                const DensitySurface& surface, const IndirectRequest& request, const Device& device,
                const SentPhotons& photons, const Progress& progress = Progress());

  /// Irradiance, W/m2, [place].
  std::vector<glm::vec3> gather(std::span<const LightMapTexel> places, Progress& progress);

  /// The same with directions: irradiance and incident radiance in SH of an order, [place][channel][value]
  /// (basis/incident_values.h).
  std::vector<float> gatherIncident(std::span<const LightMapTexel> places, Progress& progress,
                                    int order = leastIncidentOrder);

  std::uint64_t rays() const { return earlierRays_ + gather_.rays(); }  ///< photons' too
  std::size_t records() const { return records_; }  ///< places of the last gather() that rays left from

 private:
  std::uint64_t gatherSeed() const;
  std::vector<glm::vec3> gatherAll(std::span<const LightMapTexel> places, Progress& progress);
  std::vector<glm::vec3> gatherSome(std::span<const LightMapTexel> places, Progress& progress);
  std::vector<glm::vec3> gatherGuided(std::span<const LightMapTexel> places,
                                      std::span<const device::Receiver> receivers, Progress& progress);

  const CompiledScene& compiled_;
  const SurfacePatches& patches_;
  IndirectRequest request_;
  std::uint32_t width_;        ///< of the map
  double spacing_;             ///< m, of its texels
  std::uint64_t earlierRays_;  ///< of photons and direct light
  IrradianceMap approximation_;
  FinalGather gather_;
  std::optional<DensityEstimator> guide_;  ///< where rays are guided
  std::size_t records_ = 0;
};

/// Radius of a density estimate at most, m: photons farther away tell nothing of a texel.
double widestEstimate(const CompiledScene& scene);

}  // namespace prelight

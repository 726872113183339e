#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "basis/incident_values.h"
#include "gi/final_gather.h"
#include "gi/irradiance_cache.h"
#include "gi/irradiance_map.h"
#include "gi/surface_patches.h"
#include "gpu/transport_scene.h"
#include "photon/density_estimator.h"
#include "photon/density_surface.h"
#include "photon/photon_tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "prelight/progress.h"
#include "prelight/shading.h"

namespace prelight {

/// Returns the number of photons for the indirect light of a map, where none is asked for: 4 per texel,
/// 50,000 to 2 million. Photons cost little beside the rays that gather, and too few of them enter a room
/// that a window lights.
std::uint64_t usualPhotons(std::size_t texels);

/// Options of IndirectLight.
struct IndirectRequest {
  /// Photons that leave lights, for the approximation that rays look up; none: the fewest usual ones.
  std::optional<std::uint64_t> photons = {};
  int nearestPhotons = 15;   ///< per estimate; at least leastNearestOfAll where some of it is direct light
  std::uint32_t rays = 128;  ///< per place, a power of two, at least 8
  std::uint64_t seed = 0;
  std::uint32_t longWay = GatherRequest{}.longWay;  ///< as in GatherRequest
  /// How direct light gets into the approximation. False: by shadow rays, which keep shadows dark, but that
  /// of many emissive triangles by photons; true: by photons like the rest, which blurs shadows (Larsen 2004,
  /// ch. 10).
  bool directByPhotons = false;
  GatherChoice gather = GatherChoice::All;
  double cacheError = IrradianceCacheOptions{}.error;  ///< error of the cache
  bool spreadsExcess = true;                           ///< of gatherSurface()
  std::uint64_t gatherSeed = 0;  ///< selects other rays for the same photons and approximation
};

/// Least number of photons in an estimate with direct light. Direct photons lie so evenly that fewer would
/// not suffice.
constexpr int leastNearestOfAll = 40;

/// Returns the photon request for sendPhotons().
PhotonRequest indirectPhotons(const TransportScene& scene, const IndirectRequest& request);

/// Returns the request per receiver. A place has several receivers if it has more rays than a receiver may
/// have.
GatherRequest gatherRequest(const IndirectRequest& request);

/// Computes indirect light at places of the surface: everything but direct light and caustics. It is a final
/// gathering over the whole hemisphere from photon densities in the texels of a light map (Larsen 2004, ch.
/// 11).
class IndirectLight {
 public:
  /// `lit` is what `scene` is made of, `patches` belong to the light map of the approximation, and `photons`
  /// are the result of sending indirectPhotons(). Scene, patches and device must outlive the object. Throws
  /// Interrupted.
  IndirectLight(const LitScene& lit, TransportScene& scene, const SurfacePatches& patches,
                const DensitySurface& surface, const IndirectRequest& request, const Device& device,
                const SentPhotons& photons, const Progress& progress = Progress());

  /// Returns irradiance, W/m2, [place].
  std::vector<glm::vec3> gather(std::span<const LightMapTexel> places, Progress& progress);

  /// Returns irradiance, W/m2, [texel of the patches' layout]. If the request says so, what single rays bring
  /// far above the others of their texel is spread over the texels around (spreadExcess()), unless rays are
  /// guided or their results interpolated.
  std::vector<glm::vec3> gatherSurface(Progress& progress);

  /// Returns irradiance and incident radiance in SH of an order, [place][channel][value]
  /// (basis/incident_values.h).
  std::vector<float> gatherIncident(std::span<const LightMapTexel> places, Progress& progress,
                                    int order = leastIncidentOrder);

  std::uint64_t rays() const { return earlierRays_ + gather_.rays(); }  ///< including those of photons
  /// Number of places that the last gather() cast rays from.
  std::size_t records() const { return records_; }

 private:
  std::uint64_t gatherSeed() const;
  std::vector<device::Receiver> receiversAt(std::span<const LightMapTexel> places) const;
  std::vector<glm::vec3> gatherAll(std::span<const LightMapTexel> places, Progress& progress);
  std::vector<glm::vec3> gatherSome(std::span<const LightMapTexel> places, Progress& progress);
  std::vector<glm::vec3> gatherGuided(std::span<const LightMapTexel> places,
                                      std::span<const device::Receiver> receivers, Progress& progress);

  const CompiledScene& compiled_;
  const SurfacePatches& patches_;
  IndirectRequest request_;
  std::uint32_t width_;        ///< width of the map
  double spacing_;             ///< distance of the map's texels, m
  std::uint64_t earlierRays_;  ///< rays of photons and direct light
  IrradianceMap approximation_;
  FinalGather gather_;
  std::optional<DensityEstimator> guide_;  ///< present if rays are guided
  std::size_t records_ = 0;
};

/// Returns the largest radius of density estimates, m. More distant photons say nothing about a texel.
double widestEstimate(const CompiledScene& scene);

/// Returns the approximate bytes that the indirect light of a light map takes temporarily, for `photons` that
/// leave lights: the photon maps and the blocks of rays for gathering. The number of photons that land is
/// that of a closed scene.
std::uint64_t indirectLightBytes(const CompiledScene& scene, std::uint64_t photons);

}  // namespace prelight

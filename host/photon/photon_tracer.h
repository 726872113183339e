#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "gpu/transport_scene.h"
#include "gpu/work_queue.h"
#include "photon/photon_sources.h"
#include "prelight/photons.h"
#include "prelight/progress.h"
#include "shared/photon_types.h"

namespace prelight {

/// Options of tracing photons.
struct PhotonRequest {
  PhotonKind kind = PhotonKind::Indirect;
  bool emittersDirectly = false;   ///< whether those straight from emissive triangles are stored as well
  bool aimed = true;               ///< whether caustic photons are emitted only towards casters
  bool sharp = false;              ///< whether only mirrors and smooth glass scatter caustic photons
  std::uint64_t photons = 100000;  ///< number of photons that leave lights
  std::uint64_t seed = 0;
  int rouletteDepth = 0;  ///< surfaces that a photon meets before Russian roulette may absorb it
  int depth = 2048;       ///< most surfaces that a photon meets
  bool flights = false;   ///< whether PhotonHits::flights are recorded
};

/// Balance of power per channel, in integer counts: sums are exact for any number of photons, and emitted =
/// absorbed + escaped + cut, except for lost photons.
struct PhotonPower {
  std::array<std::int64_t, 3> emitted{};
  std::array<std::int64_t, 3> absorbed{};  ///< by surfaces, within media and beyond lights' ranges
  std::array<std::int64_t, 3> escaped{};   ///< left the scene
  std::array<std::int64_t, 3> cut{};       ///< power of photons that PhotonRequest::depth has ended
  double unit = 0.0;                       ///< W per count

  glm::dvec3 watts(const std::array<std::int64_t, 3>& counts) const {
    return unit * glm::dvec3(counts[0], counts[1], counts[2]);
  }
};

/// Statistics of tracing photons.
struct PhotonReport {
  PhotonPower power;
  std::uint64_t emitted = 0;  ///< photons emitted
  std::uint64_t stored = 0;   ///< hits stored
  std::uint64_t rays = 0;

  /// Adds the counts of other photons; the unit of power stays.
  void add(const PhotonReport& more);
};

/// A photon's path from one surface to the next, as it was traced.
struct PhotonFlight {
  device::Ray ray;             ///< tMax is t of the hit; unbounded if the photon left the scene
  std::uint32_t triangle = 0;  ///< triangle of the hit, or PRELIGHT_NO_TRIANGLE
};

/// Stored hits of photons, in an order that depends only on scene and request.
struct PhotonHits {
  std::vector<device::Photon> photons;
  std::vector<std::uint32_t> paths;        ///< [photon], number of its path over all sources
  std::vector<PhotonFlight> flights;       ///< if requested; those of a path are in order
  std::vector<std::uint32_t> flightPaths;  ///< [flight]
  /// [triangle], 1: photons met its back, which is one-sided and reflects diffusely. Empty: there are none.
  std::vector<std::uint8_t> backs;

  void append(const PhotonHits& more);
};

/// Traces photons through a scene, block by block.
class PhotonTracer {
 public:
  /// The arguments must outlive the object.
  PhotonTracer(const CompiledScene& compiled, TransportScene& scene);

  /// Traces a request and appends to `hits`. Throws Interrupted between blocks, which are kept.
  PhotonReport trace(const PhotonRequest& request, PhotonHits& hits, Progress& progress);

  /// Traces a request, passes the hits of each block to `sink` and keeps nothing.
  using Sink = std::function<void(const PhotonHits& block)>;
  PhotonReport trace(const PhotonRequest& request, const Sink& sink, Progress& progress);

  /// Traces all photons of given sources and appends to `hits`. Blocks are kept.
  PhotonReport trace(const PhotonRequest& request, const PhotonSources& sources, PhotonHits& hits,
                     Progress& progress);

  /// Traces photons of one source, selected by their numbers, each equal to the photon of this number among
  /// all. Appends to `hits`, where the number of a path is its index in the selection. `sources` are those of
  /// the present scene.
  PhotonReport trace(const PhotonRequest& request, const PhotonSources& sources, std::size_t source,
                     std::span<const std::uint32_t> photons, PhotonHits& hits, Progress& progress);

 private:
  /// State of tracing a request.
  struct Course {
    std::uint64_t source = 0;   ///< current source
    std::uint32_t photons = 0;  ///< photons sent of this source
    std::uint32_t paths = 0;    ///< paths sent of all sources
    PhotonReport report;
  };

  PhotonSources sourcesOf(const PhotonRequest& request) const;
  void begin(const PhotonRequest& request, const PhotonSources& sources, Course& at);
  void sendBlock(const PhotonRequest& request, const PhotonSources& sources, Course& at, PhotonHits& block,
                 Progress& progress);
  void setBlock(const PhotonSources& sources, const Course& at, Progress& progress);
  void pass(const PhotonSources& sources, Course& at) const;
  template <typename State>
  void exchange(State& state, const PhotonSources& sources, Course& at, PhotonHits& hits) const;
  template <typename State>
  void exchangeHits(State& state, std::uint32_t firstPath, std::uint32_t endPath, PhotonHits& hits) const;
  void build(const PhotonRequest& request, const PhotonSources& sources);
  void traceBlock(const PhotonRequest& request, std::uint32_t firstPath, PhotonHits& hits,
                  PhotonReport& report);
  std::uint32_t scatter(const PhotonRequest& request, std::uint32_t count, std::uint32_t depth,
                        std::uint32_t firstPath, PhotonHits& hits, PhotonReport& report);
  void endUnimportant(std::uint32_t count, std::uint32_t depth);
  void markBacks(std::uint32_t count, PhotonHits& hits);
  void store(std::uint32_t count, std::uint32_t firstPath, PhotonHits& hits);
  void keepFlights(std::uint32_t count, std::uint32_t firstPath, PhotonHits& hits);
  void sum(std::uint32_t count, std::uint32_t columns, std::span<std::int64_t> sums);

  const CompiledScene& compiled_;
  TransportScene& scene_;
  DeviceContext& device_;
  std::uint32_t blockPhotons_;
  device::PhotonParameters values_{};
  Buffer<device::PhotonParameters> parameters_;
  Buffer<device::SourceCell> cells_;
  Buffer<std::uint32_t> chosen_;
  std::optional<device::ImportanceGrid> leastGrid_;  ///< present if photons end by importance
  Buffer<float> least_;                              ///< W, thresholds in this grid
  Buffer<device::PhotonPath> paths_;
  Buffer<device::Ray> rays_;  ///< [rays to trace, rays that scattering continues][blockPhotons_]
  Buffer<std::uint32_t> queue_, nextQueue_;
  Buffer<device::Hit> hits_;
  Buffer<device::Photon> candidates_, photons_;
  Buffer<std::uint32_t> numbers_;
  Buffer<std::uint8_t> outcomes_;
  Buffer<std::int64_t> tallies_, sums_;
  WorkQueue work_;  ///< lists outcomes

  using Parameters = Buffer<device::PhotonParameters>;
  using Numbers = Buffer<std::uint32_t>;
  Kernel<Parameters, Buffer<device::SurfaceLine>, Buffer<device::ShadingLine>, Buffer<device::LightLine>,
         Buffer<device::SourceCell>, Numbers, Buffer<device::PhotonPath>, Numbers, Buffer<device::Ray>,
         Buffer<std::int64_t>>
      emit_;
  Kernel<Parameters, device::PhotonStep, Buffer<device::SurfaceLine>, Buffer<device::ShadingLine>,
         Buffer<device::LightLine>, Buffer<device::Ray>, Buffer<device::Hit>, Numbers,
         Buffer<device::PhotonPath>, Buffer<std::uint8_t>, Buffer<device::Photon>, Buffer<std::int64_t>>
      scatter_;
  Kernel<Parameters, device::PhotonStep, device::ImportanceGrid, Buffer<float>, Buffer<device::Ray>,
         Buffer<device::Hit>, Numbers, Buffer<device::PhotonPath>, Buffer<std::uint8_t>, Buffer<std::int64_t>>
      endUnimportant_;
  Kernel<std::uint32_t, std::uint32_t, std::uint32_t, Buffer<std::int64_t>, Buffer<std::int64_t>> sum_;
};

/// Stored hits of photons, with statistics.
struct SentPhotons {
  PhotonHits hits;
  PhotonReport report;
};

/// Sends all photons of a request. Throws Interrupted between blocks.
SentPhotons sendPhotons(const CompiledScene& compiled, TransportScene& scene, const PhotonRequest& request,
                        Progress& progress);

}  // namespace prelight

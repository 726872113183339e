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

struct PhotonRequest {
  PhotonKind kind = PhotonKind::Indirect;
  bool aimed = true;               ///< caustic photons leave towards casters alone; false: everywhere
  bool sharp = false;              ///< caustic ones: mirrors and smooth glass alone scatter them
  std::uint64_t photons = 100000;  ///< that leave lights
  std::uint64_t seed = 0;
  int rouletteDepth = 0;  ///< surfaces that a photon meets before it may be absorbed by chance
  int depth = 2048;       ///< surfaces that it meets at most
  bool flights = false;   ///< PhotonHits::flights are wanted, too
};

/// Where the power went, a channel. Sums of whole counts: exact, whatever their number, and
/// emitted = absorbed + escaped + cut but for photons that were lost.
struct PhotonPower {
  std::array<std::int64_t, 3> emitted{};
  std::array<std::int64_t, 3> absorbed{};  ///< by surfaces, within media and beyond lights' ranges
  std::array<std::int64_t, 3> escaped{};   ///< from the scene
  std::array<std::int64_t, 3> cut{};       ///< still on its way when PhotonRequest::depth ended it
  double unit = 0.0;                       ///< W a count

  glm::dvec3 watts(const std::array<std::int64_t, 3>& counts) const {
    return unit * glm::dvec3(counts[0], counts[1], counts[2]);
  }
};

struct PhotonReport {
  PhotonPower power;
  std::uint64_t emitted = 0;  ///< photons
  std::uint64_t stored = 0;   ///< hits that were kept
  std::uint64_t rays = 0;
};

/// A photon on its way from one surface to the next, as it was traced.
struct PhotonFlight {
  device::Ray ray;             ///< tMax: t of the hit; unbounded where the photon left the scene
  std::uint32_t triangle = 0;  ///< that it met, or PRELIGHT_NO_TRIANGLE
};

/// What photons left behind, in an order that only the scene and the request decide.
struct PhotonHits {
  std::vector<device::Photon> photons;
  std::vector<std::uint32_t> paths;        ///< [photon], number of its path over all sources
  std::vector<PhotonFlight> flights;       ///< where they were asked for; of a path in their order
  std::vector<std::uint32_t> flightPaths;  ///< [flight]
  /// [triangle], 1: photons met its back, which is one-sided and reflects diffusely. Empty: they met none.
  std::vector<std::uint8_t> backs;

  void append(const PhotonHits& more);
};

/// Sends photons through a scene, block by block.
class PhotonTracer {
 public:
  /// The arguments outlive it.
  PhotonTracer(const CompiledScene& compiled, TransportScene& scene);

  /// Appends to `hits`. Throws Interrupted between blocks, which are kept.
  PhotonReport trace(const PhotonRequest& request, PhotonHits& hits, Progress& progress);

  /// Traces likewise, but hands the hits of each block over and keeps nothing.
  using Sink = std::function<void(const PhotonHits& block)>;
  PhotonReport trace(const PhotonRequest& request, const Sink& sink, Progress& progress);

  /// All photons of sources that somebody else has chosen. Appends to `hits`, and keeps blocks.
  PhotonReport trace(const PhotonRequest& request, const PhotonSources& sources, PhotonHits& hits,
                     Progress& progress);

  /// Traces photons of one source, chosen by their numbers, each as it is among all. Appends to `hits`,
  /// where a path's number is its place in the choice. `sources`: of the scene as it is.
  PhotonReport trace(const PhotonRequest& request, const PhotonSources& sources, std::size_t source,
                     std::span<const std::uint32_t> photons, PhotonHits& hits, Progress& progress);

 private:
  /// What has been sent.
  struct Course {
    std::uint64_t source = 0;   ///< at hand
    std::uint32_t photons = 0;  ///< of this source
    std::uint32_t paths = 0;    ///< of all sources
    PhotonReport report;
  };

  PhotonSources sourcesOf(const PhotonRequest& request) const;
  void begin(const PhotonRequest& request, const PhotonSources& sources, Course& at);
  void sendBlock(const PhotonRequest& request, const PhotonSources& sources, Course& at, PhotonHits& block,
                 Progress& progress);
  template <typename State>
  void exchange(State& state, const PhotonSources& sources, Course& at, PhotonHits& hits) const;
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
  std::optional<device::ImportanceGrid> leastGrid_;  ///< where photons may end by their importance
  Buffer<float> least_;                              ///< W, of these
  Buffer<device::PhotonPath> paths_;
  Buffer<device::Ray> rays_;  ///< [those to trace, those that scattering sends on][blockPhotons_]
  Buffer<std::uint32_t> queue_, nextQueue_;
  Buffer<device::Hit> hits_;
  Buffer<device::Photon> candidates_, photons_;
  Buffer<std::uint32_t> numbers_;
  Buffer<std::uint8_t> outcomes_;
  Buffer<std::int64_t> tallies_, sums_;
  WorkQueue work_;  ///< of outcomes

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

}  // namespace prelight

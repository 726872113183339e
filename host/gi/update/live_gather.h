#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "bvh/binary_bvh.h"
#include "gi/final_gather.h"
#include "gi/update/live_approximation.h"
#include "prelight/light_map.h"
#include "scene/surface/surface_regions.h"

namespace prelight {

/// Which regions of the surface see which others, as mean form factors that the rays of gathered texels have
/// sampled so far. They predict where light that has changed on one region changes others.
class RegionLinks {
 public:
  /// `relays`, [region], is 1 for mirrors, glass and glossy surfaces, which pass on what they see.
  RegionLinks(const SurfaceRegions& regions, std::vector<std::uint8_t> relays);

  /// Adds the triangles that rays from a region have met, or none.
  void add(std::uint32_t region, std::span<const std::uint32_t> triangles);

  /// Ends a pass in which every region reported what it sees. Beyond twice that number of rays, new reports
  /// displace older ones.
  void endPass();

  /// Adds to `expected`, [region], the changes due to changed irradiance elsewhere, W/m2, as if all surfaces
  /// were white. Relays do not pass on changes below `least`.
  void spread(std::span<const RegionChange> changes, double least, std::span<double> expected) const;

 private:
  void spreadFrom(const RegionChange& change, std::optional<double> least, std::span<double> expected) const;
  double formFactor(std::uint32_t from, std::uint32_t to) const;

  std::vector<std::uint32_t> regionOf_;  ///< [triangle]
  std::vector<double> areas_;
  std::vector<std::uint8_t> relays_;
  std::vector<double> most_;  ///< [region], number of rays beyond which older ones count half
  std::vector<double> rays_;  ///< [region]
  std::vector<std::unordered_map<std::uint32_t, double>> hits_;  ///< [region], number of hits by region
  std::vector<std::vector<std::uint32_t>> neighbours_;  ///< [region], regions that see it or that it sees
};

/// Options of LiveGather.
struct LiveGatherOptions {
  std::uint32_t rays = 256;           ///< per texel, a power of two, at least 8
  std::uint32_t texelsPerFrame = 20;  ///< most texels gathered again per frame; 0: all that wait
  std::uint32_t blendFrames = 8;      ///< frames to blend from a texel's old value to the new one, at least 1
  /// Expected relative change of a texel's irradiance from which it is gathered again.
  double leastChange = 1e-3;
  std::uint64_t seed = 0;
};

/// Work of one frame.
struct GatherFrame {
  std::uint32_t texels = 0;   ///< texels gathered again
  std::uint32_t waiting = 0;  ///< texels left to gather
  std::uint32_t blending = 0;
  std::uint64_t rays = 0;
};

/// Indirect light at the texels of a light map. A few texels per frame are gathered again, those with the
/// greatest expected change first, and blended so that nothing pops (Larsen 2004, ch. 11).
class LiveGather {
 public:
  /// No texel is gathered yet. All arguments but the layout must outlive the object.
  LiveGather(const CompiledScene& scene, TransportScene& transport, const LightMapLayout& layout,
             const SurfaceRegions& regions, const IrradianceMap& approximation,
             const LiveGatherOptions& options);

  /// Reports that triangles, which form whole regions, have moved to their place in the scene. The regions'
  /// texels are gathered first, and texels that see the old or the new place are expected to change.
  /// `irradiance` is the mean of all light over the scene, W/m2.
  void moved(std::span<const std::uint32_t> triangles, double irradiance, Progress& progress);

  void approximationChanged(std::span<const RegionChange> changes);

  /// Sets a coarse light at the texels, W/m2, [place]. Texels gathered before follow its changes until they
  /// are gathered again, those with the greatest changes first.
  void coarseChanged(std::span<const glm::vec3> light);

  /// Sets the eye, scene coordinates. Texels that face it and are near it come first.
  void look(const glm::dvec3& eye);

  /// Gathers all texels again and shows the results at once.
  void gatherAll(Progress& progress);

  /// Gathers at most `texels` again, and blends.
  GatherFrame advance(std::uint32_t texels, Progress& progress);

  /// Returns the rays of a texel.
  std::uint32_t raysOfTexel() const { return rays_ * receivers_; }

  bool settled() const;

  /// Returns the change that is expected at each texel that waits, W/m2, [place of the layout's texels]:
  /// infinite where it has moved, and 0 where it does not wait.
  std::vector<double> expectedChanges() const;

  /// Irradiance as shown and as gathered, W/m2, [place of the layout's texels].
  std::span<const glm::vec3> shown() const { return shown_; }
  std::span<const glm::vec3> gathered() const { return gathered_; }

 private:
  double expectedChange(std::size_t place) const;
  double coarseChange(std::size_t place) const;
  double urgency(std::size_t place) const;
  glm::vec3 target(std::size_t place) const;
  bool waits(std::size_t place, double mean) const;
  double meanIrradiance() const;
  std::vector<std::uint32_t> choose(std::uint32_t texels, std::size_t& waitingCount) const;
  void gather(std::span<const std::uint32_t> places, Progress& progress);
  void growBy(std::uint32_t triangle);
  void blend(GatherFrame& frame);
  void announceMoved();
  void lookAround(std::span<const std::uint32_t> triangles, Progress& progress);

  const CompiledScene& scene_;
  LiveGatherOptions options_;
  std::uint32_t rays_, receivers_;  ///< rays per receiver, receivers per texel
  FinalGather gather_;
  std::vector<LightMapTexel> places_;
  std::vector<std::uint32_t> regionOf_;         ///< [place]
  std::vector<std::uint32_t> triangleRegions_;  ///< [triangle]
  std::vector<std::uint8_t> bare_;              ///< [region], 1: it has no texels
  RegionLinks links_;
  std::vector<double> expected_;      ///< [region], change since the start, W/m2
  std::vector<double> seenExpected_;  ///< [place], `expected_` of its region when the place was gathered
  std::vector<double> near_;          ///< [place], change that nearby moved objects may cause, W/m2
  std::vector<std::uint8_t> first_;   ///< [place], 1: it has moved and comes first
  std::vector<Box> boxes_;            ///< [region], bounds when it last moved
  double movedIrradiance_ = 0.0;      ///< W/m2, light that moved objects may have revealed or hidden
  std::uint64_t countedRays_ = 0;     ///< rays that frames have reported
  std::vector<std::uint32_t> movedRegions_;  ///< moved regions whose new view is not yet known
  std::vector<double> weights_;              ///< [place], importance to the eye, 0 to 1
  std::vector<glm::vec3> gathered_, shown_;
  std::vector<glm::vec3> coarse_, coarseThen_;  ///< [place], coarse light now and when it was gathered
  std::vector<glm::vec3> offset_;  ///< [place], what was shown in place of the value gathered last, from it
  std::vector<std::uint32_t> blendLeft_;  ///< [place], frames left
};

}  // namespace prelight

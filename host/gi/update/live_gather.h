#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bvh/box.h"
#include "gi/final_gather.h"
#include "gi/update/region_links.h"
#include "prelight/light_map.h"

namespace prelight {

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

  /// Gathers all texels again and shows the results at once.
  void gatherAll(Progress& progress);

  GatherFrame advance(Progress& progress);

  bool settled() const;

  /// Irradiance as shown and as gathered, W/m2, [place of the layout's texels].
  std::span<const glm::vec3> shown() const { return shown_; }
  std::span<const glm::vec3> gathered() const { return gathered_; }

 private:
  double priority(std::size_t place) const;
  bool waits(std::size_t place, double mean) const;
  double meanIrradiance() const;
  std::vector<std::uint32_t> choose(std::size_t& waitingCount) const;
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
  std::vector<glm::vec3> gathered_, shown_;
  std::vector<std::uint32_t> blendLeft_;  ///< [place], frames left
};

}  // namespace prelight

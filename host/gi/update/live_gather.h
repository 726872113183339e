#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bvh/box.h"
#include "gi/final_gather.h"
#include "gi/update/region_links.h"
#include "prelight/light_map.h"

namespace prelight {

struct LiveGatherOptions {
  std::uint32_t rays = 256;           ///< a texel, a power of two from 8 on
  std::uint32_t texelsPerFrame = 20;  ///< gathered again at most; 0: all that wait
  std::uint32_t blendFrames = 8;      ///< from what a texel showed to what was gathered, 1 or more
  /// Share of a texel's irradiance that is expected to have changed before it is gathered again.
  double leastChange = 1e-3;
  std::uint64_t seed = 0;
};

struct GatherFrame {
  std::uint32_t texels = 0;   ///< gathered again
  std::uint32_t waiting = 0;  ///< that are left to gather
  std::uint32_t blending = 0;
  std::uint64_t rays = 0;
};

/// Indirect light at the texels of a light map, gathered again where it is expected to have changed most, a
/// few texels a frame, and blended so that nothing pops (Larsen 2004, ch. 11).
class LiveGather {
 public:
  /// No texel is gathered yet. The arguments but the layout outlive it.
  LiveGather(const CompiledScene& scene, TransportScene& transport, const LightMapLayout& layout,
             const SurfaceRegions& regions, const IrradianceMap& approximation,
             const LiveGatherOptions& options);

  /// Regions of triangles, whole ones, are where the scene has them now: their texels come first, and those
  /// that see where they were or are now are expected to change. `irradiance`: the scene's mean of all light,
  /// W/m2.
  void moved(std::span<const std::uint32_t> triangles, double irradiance, Progress& progress);

  void approximationChanged(std::span<const RegionChange> changes);

  /// Gathers all texels again, and shows them at once.
  void gatherAll(Progress& progress);

  GatherFrame advance(Progress& progress);

  bool settled() const;

  /// Irradiance that is shown and that was gathered, W/m2, [place of the layout's texels].
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
  std::uint32_t rays_, receivers_;  ///< rays of a receiver, receivers of a texel
  FinalGather gather_;
  std::vector<LightMapTexel> places_;
  std::vector<std::uint32_t> regionOf_;         ///< [place]
  std::vector<std::uint32_t> triangleRegions_;  ///< [triangle]
  std::vector<std::uint8_t> bare_;              ///< [region], 1: it has no texels
  RegionLinks links_;
  std::vector<double> expected_;             ///< [region] change since the start, W/m2
  std::vector<double> seenExpected_;         ///< [place] of its region's, when it was gathered
  std::vector<double> near_;                 ///< [place] that what moved nearby may bring about, W/m2
  std::vector<std::uint8_t> first_;          ///< [place], 1: it has moved
  std::vector<Box> boxes_;                   ///< [region] that it was in when it last moved
  double movedIrradiance_ = 0.0;             ///< W/m2, that what has moved may have shown or hidden
  std::uint64_t countedRays_ = 0;            ///< that frames have told of
  std::vector<std::uint32_t> movedRegions_;  ///< whose new view is not yet known
  std::vector<glm::vec3> gathered_, shown_;
  std::vector<std::uint32_t> blendLeft_;  ///< [place] frames
};

}  // namespace prelight

#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "cast/column.h"
#include "gpu/tracer.h"
#include "gpu/work_queue.h"
#include "prelight/compiled_scene.h"
#include "shared/occluder_types.h"
#include "shared/shade_types.h"

namespace prelight {

/// [material], PRELIGHT_OCCLUDER_*.
std::vector<std::uint32_t> occluderFlags(const CompiledScene& scene);

/// The rays that go on from where a block's rays met shiny surfaces or glass: mirrored ones, to find out
/// whether that way is open (Sherif 2013, Figure 7.11), and refracted ones, until they are in free space
/// (7.2.3).
class OccluderWays {
 public:
  /// `rays`: of a block, at most. `told`: the scene with what occluders are told apart by.
  OccluderWays(const CompiledScene& scene, const DeviceScene& told, const BuildOptions& surfaceOptions,
               std::size_t rays);

  bool hasMirrors() const { return hasMirrors_; }
  bool hasGlass() const { return hasGlass_; }

  void cast(const CastBlockBuffers& block, std::size_t rays, Tracer& tracer);

  /// The ways of the block that was cast last, [ray][PRELIGHT_WAYS].
  const Buffer<device::OccluderWay>& ways() const { return ways_; }
  /// [ray of a mirrored way]
  const Buffer<device::Hit>& mirrorHits() const { return mirrorHits_; }

  std::uint64_t rays() const { return rays_; }

 private:
  void castMirrored(const CastBlockBuffers& block, std::size_t rays, Tracer& tracer);
  void castThrough(const CastBlockBuffers& block, std::size_t rays, Tracer& tracer);

  DeviceScene scene_;  ///< with shading
  bool hasMirrors_, hasGlass_;
  float reach_;
  std::uint32_t mostRays_;
  std::uint64_t rays_ = 0;
  Buffer<std::uint8_t> marks_;
  std::optional<WorkQueue> queue_;  ///< of marks
  Buffer<device::OccluderWay> ways_;
  Buffer<device::Ray> mirrorRays_;  ///< [those of the block's rays, those that are cast][mostRays_]
  Buffer<device::Hit> mirrorHits_, pathHits_;
  Buffer<device::Ray> pathRays_;     ///< [those to trace, those that go on][mostRays_]
  Buffer<device::GlassPath> paths_;  ///< the same

  using Parameters = Buffer<device::CastParameters>;
  using Layout = Buffer<device::SceneLayout>;
  using Surface = Buffer<device::SurfaceLine>;
  using Shading = Buffer<device::ShadingLine>;
  using Occluders = Buffer<device::OccluderLine>;
  using Rays = Buffer<device::Ray>;
  using Hits = Buffer<device::Hit>;
  using Ways = Buffer<device::OccluderWay>;
  using Paths = Buffer<device::GlassPath>;
  using Marks = Buffer<std::uint8_t>;
  using Lists = Buffer<std::uint32_t>;
  Kernel<Parameters, Layout, Surface, Shading, Occluders, Rays, Hits, float, Ways, Rays, Marks> listMirrored_;
  Kernel<std::uint32_t, std::uint32_t, Lists, Ways> numberMirrored_;
  Kernel<Parameters, Layout, Surface, Occluders, Hits, Ways, Marks> listGlass_;
  Kernel<std::uint32_t, std::uint32_t, Lists, Rays, Hits, Paths, Rays, Hits> startGlass_;
  Kernel<Layout, device::GlassStep, Surface, Shading, Occluders, Paths, Rays, Hits, Ways, Marks> followGlass_;
};

}  // namespace prelight

#pragma once

#include <cstdint>

#include "gpu/device_scene.h"
#include "gpu/tracer.h"
#include "gpu/work_queue.h"
#include "shared/walk_types.h"

namespace prelight {

/// Traces rays within bodies that scatter light to where they leave them or meet something. All light
/// transport uses it.
class MediumWalker {
 public:
  /// `options` are those of the programs that access the scene. Steps have at most `most` rays.
  MediumWalker(DeviceContext& device, const BuildOptions& options, std::uint32_t most);

  /// [ray]. The caller sets the walks before a step (beginWalk or noWalk of kernels/transport/walk_funcs.cl);
  /// run() sets them to their final state.
  Buffer<device::MediumWalk>& walks() { return walks_; }

  /// Walks the marked ones of `count` traced rays. Rays and hits become those of the last step.
  void run(const DeviceScene& scene, Tracer& tracer, Buffer<device::Ray>& rays, Buffer<device::Hit>& hits,
           const Buffer<std::uint8_t>& marks, std::uint32_t count);

  /// Returns the number of rays cast so far.
  std::uint64_t rays() const { return rays_; }

 private:
  using Rays = Buffer<device::Ray>;
  using Hits = Buffer<device::Hit>;
  using Walks = Buffer<device::MediumWalk>;

  std::uint32_t most_;
  std::uint64_t rays_ = 0;
  WorkQueue queue_;
  Walks walks_;
  Rays stepRays_;    ///< [rays to trace, rays that continue][most_]
  Walks stepWalks_;  ///< as stepRays_
  Hits stepHits_;
  Buffer<std::uint8_t> stepMarks_;
  Kernel<std::uint32_t, std::uint32_t, Buffer<device::SceneLayout>, Buffer<device::SurfaceLine>,
         Buffer<device::ShadingLine>, Rays, Hits, Walks, Rays, Hits, Walks, Buffer<std::uint8_t>>
      step_;
};

}  // namespace prelight

#pragma once

#include <cstdint>

#include "gpu/device_scene.h"
#include "gpu/tracer.h"
#include "gpu/work_queue.h"
#include "shared/walk_types.h"

namespace prelight {

/// Takes rays that run through bodies which scatter light to where they leave these or meet something: for
/// all that follows light.
class MediumWalker {
 public:
  /// `options` are those of the programs that look at the scene; serves steps of at most `most` rays.
  MediumWalker(DeviceContext& device, const BuildOptions& options, std::uint32_t most);

  /// [ray], set where a step begins by who begins them (beginWalk of kernels/transport/walk_funcs.cl or
  /// noWalk), and to what they carry at their ends by run().
  Buffer<device::MediumWalk>& walks() { return walks_; }

  /// Walks of the marked ones of `count` rays, which have been traced. Rays and hits become those of the last
  /// step.
  void run(const DeviceScene& scene, Tracer& tracer, Buffer<device::Ray>& rays, Buffer<device::Hit>& hits,
           const Buffer<std::uint8_t>& marks, std::uint32_t count);

  /// Cast so far.
  std::uint64_t rays() const { return rays_; }

 private:
  using Rays = Buffer<device::Ray>;
  using Hits = Buffer<device::Hit>;
  using Walks = Buffer<device::MediumWalk>;

  std::uint32_t most_;
  std::uint64_t rays_ = 0;
  WorkQueue queue_;
  Walks walks_;
  Rays stepRays_;    ///< [those to trace, those that go on][most_]
  Walks stepWalks_;  ///< as stepRays_
  Hits stepHits_;
  Buffer<std::uint8_t> stepMarks_;
  Kernel<std::uint32_t, std::uint32_t, Buffer<device::SceneLayout>, Buffer<device::SurfaceLine>,
         Buffer<device::ShadingLine>, Rays, Hits, Walks, Rays, Hits, Walks, Buffer<std::uint8_t>>
      step_;
};

}  // namespace prelight

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "benchmarks/run/measure.h"
#include "device/buffer.h"
#include "gpu/tracer.h"
#include "shared/ray_types.h"

/// The rays that tracing is measured with, and how they are launched.
namespace prelight::benchmarks {

/// Rays of a launch, as in a bake: what fits a CPU's cache, what fills a GPU.
std::size_t raysPerLaunch(const DeviceInfo& info);

/// Rays of receivers all over the scene in the order in which a bake casts them: all directions of a receiver
/// (a power of two, at least 8) together. About `count` rays.
std::vector<device::Ray> bakeRays(const CompiledScene& scene, DeviceContext& device, std::uint64_t count,
                                  std::uint32_t raysPerReceiver);

/// As bakeRays, but of a bake with a receiver a triangle, of which evenly spaced launches are taken whole.
std::vector<device::Ray> bakeLaunches(const CompiledScene& scene, DeviceContext& device, std::uint64_t count,
                                      std::uint32_t raysPerReceiver);

std::vector<device::Ray> shuffled(std::vector<device::Ray> rays);

/// Copies of the rays, no longer than `reach`.
std::vector<device::Ray> limited(std::vector<device::Ray> rays, float reach);

/// Rays of the scene's camera through the pixels of a square picture, by tiles of 8 x 8 pixels.
std::vector<device::Ray> cameraRays(const BenchmarkScene& scene, std::uint64_t count);

/// Paths of photons from the scene's lights over diffuse bounces, a bounce of all photons of a launch at a
/// time: incoherent starts and directions.
std::vector<device::Ray> photonRays(const BenchmarkScene& scene, Tracer& tracer, std::uint64_t count);

/// Rays on the device, a buffer a launch.
class RayBlocks {
 public:
  RayBlocks(DeviceContext& device, std::span<const device::Ray> rays);

  std::size_t rayCount() const { return count_; }
  std::size_t launchCount() const { return launches_.size(); }

  /// Traces launches [first, last) and waits for them.
  void trace(Tracer& tracer, bool any, std::size_t first, std::size_t last);

  /// Traces all and reads what they hit.
  std::vector<device::Hit> hits(Tracer& tracer, bool any);

 private:
  void launch(Tracer& tracer, bool any, std::size_t index);

  DeviceContext& device_;
  std::size_t count_;
  std::vector<Buffer<device::Ray>> launches_;
  Buffer<device::Hit> hits_;
};

}  // namespace prelight::benchmarks

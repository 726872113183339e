#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "benchmarks/run/measure.h"
#include "device/buffer.h"
#include "gpu/tracer.h"
#include "shared/ray_types.h"

/// Rays by which tracing is measured, and their launches.
namespace prelight::benchmarks {

/// Returns the rays per launch, as in a bake: few enough for the cache of a CPU, enough to fill a GPU.
std::size_t raysPerLaunch(const DeviceInfo& info);

/// Returns about `count` rays of receivers all over the scene in the order of a bake: all directions of a
/// receiver (a power of two, at least 8) together.
std::vector<device::Ray> bakeRays(const CompiledScene& scene, DeviceContext& device, std::uint64_t count,
                                  std::uint32_t raysPerReceiver);

/// Like bakeRays(), but of a bake with one receiver per triangle, of which evenly spaced whole launches are
/// taken.
std::vector<device::Ray> bakeLaunches(const CompiledScene& scene, DeviceContext& device, std::uint64_t count,
                                      std::uint32_t raysPerReceiver);

std::vector<device::Ray> shuffled(std::vector<device::Ray> rays);

/// Returns the rays shortened to `reach`.
std::vector<device::Ray> limited(std::vector<device::Ray> rays, float reach);

/// Returns the rays of the scene's camera through the pixels of a square picture, in tiles of 8 x 8 pixels.
std::vector<device::Ray> cameraRays(const BenchmarkScene& scene, std::uint64_t count);

/// Returns rays of photon paths from the scene's lights over diffuse bounces, ordered by bounce within each
/// launch, so that starts and directions are incoherent.
std::vector<device::Ray> photonRays(const BenchmarkScene& scene, Tracer& tracer, std::uint64_t count);

/// Rays on the device, one buffer per launch.
class RayBlocks {
 public:
  RayBlocks(DeviceContext& device, std::span<const device::Ray> rays);

  std::size_t rayCount() const { return count_; }
  std::size_t launchCount() const { return launches_.size(); }

  /// Traces launches [first, last) and waits for them.
  void trace(Tracer& tracer, bool any, std::size_t first, std::size_t last);

  /// Traces all rays and returns their hits.
  std::vector<device::Hit> hits(Tracer& tracer, bool any);

 private:
  void launch(Tracer& tracer, bool any, std::size_t index);

  DeviceContext& device_;
  std::size_t count_;
  std::vector<Buffer<device::Ray>> launches_;
  Buffer<device::Hit> hits_;
};

}  // namespace prelight::benchmarks

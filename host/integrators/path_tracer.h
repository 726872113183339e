#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/transport_scene.h"
#include "integrators/cached_light.h"
#include "integrators/reference.h"
#include "integrators/reference_plan.h"
#include "integrators/virtual_lights.h"
#include "shared/reference_types.h"

namespace prelight::reference {

/// The device's part of a reference picture: one pass over a block of pixels at a time.
class PathTracer {
 public:
  /// The scene outlives it, and visits punctual lights in turn if the integrator does. With `cached` light
  /// paths end at surfaces that reflect diffusely, whatever the integrator.
  PathTracer(TransportScene& scene, const CompiledScene& compiled, const Camera& camera,
             const ReferenceRequest& request, const CachedLight* cached = nullptr);

  /// Pixels a block at most.
  std::uint32_t blockPixels() const { return blockPixels_; }

  /// Mean radiance of `count` pixels from `first` on, over the samples of pass `pass`. Depends on nothing
  /// else.
  const std::vector<glm::vec4>& trace(std::uint64_t pass, std::uint32_t first, std::uint32_t count);

  std::uint64_t rays() const { return rays_ + (virtual_ ? virtual_->rays() : 0); }

 private:
  void buildKernels(const ReferenceRequest& request);
  void buildCachedKernels(const ReferenceRequest& request, const CompiledScene& compiled,
                          const CachedLight& cached);
  void tracePaths(std::uint32_t depth, std::uint32_t& count);
  std::uint32_t followToCachedLight(std::uint32_t count, std::uint32_t depth);
  void collect(std::uint32_t count, std::uint32_t depth);
  void addDirectLight(std::uint32_t count, std::uint32_t depth, std::uint32_t light);
  void addVirtualLights(std::uint32_t count);
  void castShadows(std::uint32_t shadows);
  std::uint32_t scatter(std::uint32_t count, std::uint32_t depth);
  std::array<std::uint32_t, 2> readCounters() const;

  TransportScene& scene_;
  DeviceContext& device_;
  ReferenceRequest request_;
  device::ReferenceParameters values_{};
  std::uint32_t blockPixels_ = 0;
  std::uint64_t rays_ = 0;
  std::vector<glm::vec4> means_;
  std::optional<VirtualLights> virtual_;
  std::optional<std::uint64_t> virtualPass_;  ///< whose lights they are

  Buffer<device::ReferenceParameters> parameters_;

  Buffer<device::PathState> paths_;
  std::array<Buffer<device::Ray>, 2> rayBuffers_;
  std::array<Buffer<std::uint32_t>, 2> queues_;
  std::size_t current_ = 0;  ///< of the two, the one to trace
  Buffer<device::Hit> hits_, shadowHits_;
  Buffer<device::Ray> shadowRays_;
  Buffer<device::ShadowItem> items_;
  Buffer<std::uint32_t> counters_;
  Buffer<glm::vec4> meanBuffer_;
  bool cached_ = false;       ///< paths end at cached light
  bool meetsLights_ = false;  ///< CachedLight::meetsLights
  cl::Kernel generate_, collect_, sample_, sampleVirtual_, follow_, add_, scatter_, average_;
};

}  // namespace prelight::reference

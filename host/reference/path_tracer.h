#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bvh/tracer.h"
#include "reference/light_tables.h"
#include "reference/reference.h"
#include "reference/reference_plan.h"
#include "shared/reference_types.h"

namespace prelight::reference {

/// The device's part of a reference picture: one pass over a block of pixels at a time.
class PathTracer {
 public:
  PathTracer(const ReferenceInputs& inputs, const ReferenceRequest& request, const Device& device);

  /// Pixels a block at most.
  std::uint32_t blockPixels() const { return blockPixels_; }

  /// Mean radiance of `count` pixels from `first` on, over the samples of pass `pass`. Depends on nothing
  /// else.
  const std::vector<glm::vec4>& trace(std::uint64_t pass, std::uint32_t first, std::uint32_t count);

  std::uint64_t rays() const { return rays_; }
  const Features& features() const { return features_; }

 private:
  void uploadScene(const ReferenceInputs& inputs);
  void uploadLights();
  void buildKernels(const ReferenceRequest& request);
  cl_uint setSurface(cl::Kernel& kernel, cl_uint index) const;
  void tracePaths(std::uint32_t depth, std::uint32_t& count);
  void collect(std::uint32_t count, std::uint32_t depth);
  void addDirectLight(std::uint32_t count, std::uint32_t depth, std::uint32_t light);
  std::uint32_t scatter(std::uint32_t count, std::uint32_t depth);
  std::array<std::uint32_t, 2> readCounters() const;

  Tracer tracer_;
  DeviceContext& device_;
  ReferenceRequest request_;
  LightTables lightTables_;
  Features features_;
  device::ReferenceParameters values_{};
  std::uint32_t blockPixels_ = 0;
  std::uint64_t rays_ = 0;
  std::vector<glm::vec4> means_;

  Buffer<device::ReferenceParameters> parameters_;
  Buffer<float> vertices_;
  Buffer<std::uint8_t> flat_;
  Buffer<glm::vec2> texCoords_;
  Buffer<device::DeviceMaterial> bases_, layers_;
  Buffer<device::ReferenceMaterial> materials_;
  Buffer<glm::u16vec4> layerTexels_;
  Buffer<std::uint32_t> tables_, emitters_;
  Buffer<float> emitterDensities_;
  Buffer<device::ReferenceLight> punctual_;
  Buffer<glm::vec4> sky_;

  Buffer<device::PathState> paths_;
  std::array<Buffer<device::Ray>, 2> rayBuffers_;
  std::array<Buffer<std::uint32_t>, 2> queues_;
  std::size_t current_ = 0;  ///< of the two, the one to trace
  Buffer<device::Hit> hits_, shadowHits_;
  Buffer<device::Ray> shadowRays_;
  Buffer<device::ShadowItem> items_;
  Buffer<std::uint32_t> counters_;
  Buffer<glm::vec4> meanBuffer_;
  cl::Kernel generate_, collect_, sample_, add_, scatter_, average_;
};

}  // namespace prelight::reference

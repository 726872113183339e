#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "denoise/denoiser.h"
#include "gpu/transport_scene.h"
#include "gpu/work_queue.h"
#include "integrators/camera_rays.h"
#include "integrators/reference.h"
#include "shared/reference_types.h"

namespace prelight::reference {

/// Traces a picture's camera rays to the first surface that is neither mirror nor glass, to make guides for a
/// denoiser.
class GuideTracer {
 public:
  /// The scene must outlive the object. `request` is that of the picture.
  GuideTracer(TransportScene& scene, const CompiledScene& compiled, const Camera& camera,
              const ReferenceRequest& request);

  /// Returns the guides of the first `passes` passes of the picture. May be called once. Throws Interrupted
  /// between blocks.
  Guides trace(std::uint64_t passes, const Progress& progress);

  std::uint64_t rays() const { return rays_; }

 private:
  void traceBlock(std::uint64_t pass, std::uint32_t first, std::uint32_t count);

  TransportScene& scene_;
  ReferenceRequest request_;
  device::ReferenceParameters values_{};
  std::uint32_t blockPixels_ = 0, mostPaths_ = 0;
  std::uint64_t rays_ = 0;
  std::vector<glm::vec4> means_;  ///< [pixel of the block][albedo, normal]

  Buffer<device::ReferenceParameters> parameters_;
  Buffer<device::PathState> paths_;
  Buffer<device::Ray> rayBuffer_;  ///< rays that are followed, overwritten by those that continue
  Buffer<std::uint32_t> numbers_, nextNumbers_;
  Buffer<device::Hit> hits_;
  Buffer<std::uint8_t> marks_;
  WorkQueue queue_;
  std::optional<CulledBacks> culled_;  ///< present if surfaces are one-sided
  Buffer<glm::vec4> meanBuffer_;
  Kernel<Buffer<device::ReferenceParameters>, Buffer<device::PathState>, Buffer<std::uint32_t>,
         Buffer<device::Ray>>
      generate_;
  Kernel<Buffer<device::ReferenceParameters>, device::PathStep, Buffer<device::SurfaceLine>,
         Buffer<device::ShadingLine>, Buffer<device::LightLine>, Buffer<device::Ray>, Buffer<device::Hit>,
         Buffer<std::uint32_t>, Buffer<device::PathState>, Buffer<std::uint8_t>>
      follow_;
  Kernel<Buffer<device::ReferenceParameters>, Buffer<device::PathState>, Buffer<glm::vec4>> average_;
};

}  // namespace prelight::reference

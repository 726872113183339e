#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/medium_walker.h"
#include "gpu/transport_scene.h"
#include "gpu/work_queue.h"
#include "integrators/cached_light.h"
#include "integrators/caustic_passes.h"
#include "integrators/culled_backs.h"
#include "integrators/reference.h"
#include "integrators/reference_plan.h"
#include "integrators/virtual_lights.h"
#include "shared/cached_light_types.h"

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
  /// else. w: luminance that the blur of caustics is likely to have added.
  const std::vector<glm::vec4>& trace(std::uint64_t pass, std::uint32_t first, std::uint32_t count);

  /// The same of the parts that it is a sum of, [PicturePart][pixel], of the last block; none where the
  /// request has no parts.
  const std::vector<glm::vec4>& parts() const { return partMeans_; }

  std::uint64_t rays() const {
    return rays_ + (virtual_ ? virtual_->rays() : 0) + (walker_ ? walker_->rays() : 0) +
           (caustics_ ? caustics_->rays() : 0) + (culled_ ? culled_->rays() : 0);
  }

 private:
  void buildKernels(const ReferenceRequest& request);
  void buildCachedKernels(const ReferenceRequest& request);
  void buildCausticKernels(const ReferenceRequest& request);
  void preparePass(std::uint64_t pass);
  void addPhotons(std::uint32_t count, std::uint32_t depth);
  void buildWalkKernels(const ReferenceRequest& request);
  void tracePaths(std::uint32_t depth, std::uint32_t& count);
  std::uint32_t followToCachedLight(std::uint32_t count, std::uint32_t depth);
  void lookThroughBacks(std::uint32_t count, std::uint32_t depth);
  void walkMedia(std::uint32_t count, std::uint32_t depth);
  void collect(std::uint32_t count, std::uint32_t depth);
  bool isLast(std::uint32_t depth) const;
  void addLights(std::uint32_t count, std::uint32_t depth);
  void addDirectLight(std::uint32_t count, std::uint32_t depth, std::uint32_t light);
  void addVirtualLights(std::uint32_t count, std::uint32_t depth);
  void castShadows(std::uint32_t shadows);
  std::uint32_t scatter(std::uint32_t count, std::uint32_t depth);
  std::uint32_t follow(std::uint32_t left);
  device::PathStep step(std::uint32_t count, std::uint32_t depth) const;

  TransportScene& scene_;
  DeviceContext& device_;
  ReferenceRequest request_;
  device::ReferenceParameters values_{};
  std::uint32_t blockPixels_ = 0;
  std::uint64_t rays_ = 0;
  std::vector<glm::vec4> means_, partMeans_;
  std::optional<VirtualLights> virtual_;
  std::optional<CausticPasses> caustics_;      ///< where punctual lights make caustics
  std::optional<std::uint64_t> preparedPass_;  ///< whose virtual lights and caustics there are

  std::uint32_t mostPaths_ = 0;  ///< of a block
  Buffer<device::ReferenceParameters> parameters_;
  Buffer<device::PathState> paths_;              ///< and their PathParts behind them, where those are wanted
  Buffer<device::Ray> rayBuffer_;                ///< [RayPart][mostPaths_]
  Buffer<std::uint32_t> numbers_, nextNumbers_;  ///< of the paths that rays belong to
  Buffer<device::Hit> hits_, shadowHits_;
  Buffer<std::uint8_t> marks_;
  std::optional<WorkQueue> queue_;      ///< of marks
  std::optional<MediumWalker> walker_;  ///< where bodies scatter light within
  std::optional<CulledBacks> culled_;   ///< where surfaces are one-sided
  Buffer<glm::vec4> meanBuffer_, partBuffer_;
  std::optional<CachedLight> cached_;  ///< paths end at it; none: they do not
  device::CachedPathParameters cachedValues_{};
  Buffer<device::CachedPathParameters> cachedParameters_;
  Buffer<device::DensityLine> cachedCaustics_;

  using Parameters = Buffer<device::ReferenceParameters>;
  using Paths = Buffer<device::PathState>;
  using Rays = Buffer<device::Ray>;
  using Hits = Buffer<device::Hit>;
  using Numbers = Buffer<std::uint32_t>;
  using Marks = Buffer<std::uint8_t>;
  using Surface = Buffer<device::SurfaceLine>;
  using Shading = Buffer<device::ShadingLine>;
  using Lights = Buffer<device::LightLine>;
  Kernel<Parameters, Paths, Numbers, Rays> generate_;
  Kernel<Parameters, device::PathStep, Surface, Shading, Lights, Rays, Hits, Numbers, Paths> collect_;
  Kernel<Parameters, device::PathStep, Surface, Shading, Lights, Rays, Hits, Numbers, Paths, Marks> sample_;
  Kernel<Parameters, device::PathStep, Surface, Shading, Rays, Hits, Numbers, Paths,
         Buffer<device::VirtualLight>, Marks>
      sampleVirtual_;
  Kernel<Buffer<device::CachedPathParameters>, device::PathStep, Surface, Shading, Lights,
         Buffer<device::IrradianceLine>, Buffer<device::DensityLine>, Rays, Hits, Numbers, Paths, Marks>
      follow_;
  Kernel<Parameters, device::PathStep, Surface, Shading, Rays, Hits, Numbers, Paths,
         Buffer<device::MediumWalk>, Marks>
      beginWalks_;
  Kernel<std::uint32_t, Buffer<device::MediumWalk>, Numbers, Paths> endWalks_;
  Kernel<std::uint32_t, std::uint32_t, Numbers, Hits, Numbers, Paths, std::uint32_t> add_;
  Kernel<Parameters, device::PathStep, Surface, Shading, Rays, Hits, Numbers, Paths, Marks> scatter_;
  Buffer<float> blurs_;  ///< [path], with caustics_
  Kernel<Parameters, device::PathStep, Surface, Shading, Buffer<device::DensityParameters>,
         Buffer<device::DensityLine>, float, Rays, Hits, Numbers, Paths, Buffer<float>>
      addPhotons_;
  Kernel<Parameters, Buffer<float>, Buffer<glm::vec4>> averageBlurs_;
  Kernel<Parameters, Paths, Buffer<glm::vec4>> average_, averageParts_;
};

}  // namespace prelight::reference

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/medium_walker.h"
#include "gpu/transport_scene.h"
#include "gpu/work_queue.h"
#include "integrators/cached_light.h"
#include "integrators/camera_rays.h"
#include "integrators/reference.h"
#include "integrators/virtual_lights.h"
#include "shared/cached_light_types.h"

namespace prelight::reference {

/// The device's part of a reference picture, which traces one pass over a block of pixels at a time.
class PathTracer {
 public:
  /// The scene must outlive the object, and must visit punctual lights in turn if the integrator does. With
  /// `cached` light, paths end at diffuse surfaces for any integrator.
  PathTracer(TransportScene& scene, const CompiledScene& compiled, const Camera& camera,
             const ReferenceRequest& request, const CachedLight* cached = nullptr);

  /// Returns the greatest number of pixels per block.
  std::uint32_t blockPixels() const { return blockPixels_; }

  /// Returns the mean radiance of `count` pixels from `first` on over the samples of pass `pass`; it depends
  /// on nothing else. w is the luminance that the blur of caustics has probably added.
  const std::vector<glm::vec4>& trace(std::uint64_t pass, std::uint32_t first, std::uint32_t count);

  /// Returns the parts of the last block, [PicturePart][pixel]; empty if the request has no parts.
  const std::vector<glm::vec4>& parts() const { return partMeans_; }

  /// Returns the luminance by which single samples raise the pixels of the last block, [pixel]; empty without
  /// cached light.
  const std::vector<float>& excess() const { return excess_; }

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
  std::vector<float> excess_;
  std::optional<VirtualLights> virtual_;
  std::optional<CausticPasses> caustics_;      ///< present if punctual lights make caustics
  std::optional<std::uint64_t> preparedPass_;  ///< pass of the present virtual lights and caustics

  std::uint32_t mostPaths_ = 0;  ///< paths of a block
  Buffer<device::ReferenceParameters> parameters_;
  Buffer<device::PathState> paths_;              ///< followed by their PathParts, if these are requested
  Buffer<device::Ray> rayBuffer_;                ///< [RayPart][mostPaths_]
  Buffer<std::uint32_t> numbers_, nextNumbers_;  ///< paths that rays belong to
  Buffer<device::Hit> hits_, shadowHits_;
  Buffer<std::uint8_t> marks_;
  std::optional<WorkQueue> queue_;      ///< compacts marked paths
  std::optional<MediumWalker> walker_;  ///< present if bodies scatter light inside
  std::optional<CulledBacks> culled_;   ///< present if surfaces are one-sided
  Buffer<glm::vec4> meanBuffer_, partBuffer_;
  std::optional<CachedLight> cached_;  ///< light at which paths end; none: they continue
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
  Buffer<float> blurs_;  ///< [path], used with caustics_
  Kernel<Parameters, device::PathStep, Surface, Shading, Buffer<device::DensityParameters>,
         Buffer<device::DensityLine>, float, Rays, Hits, Numbers, Paths, Buffer<float>>
      addPhotons_;
  Kernel<Parameters, Buffer<float>, Buffer<glm::vec4>> averageBlurs_;
  Kernel<Parameters, Paths, Buffer<glm::vec4>> average_, averageParts_;
  Buffer<float> excessBuffer_;  ///< [pixel], used with cached light
  Kernel<Parameters, Paths, Buffer<float>> measureExcess_;
};

}  // namespace prelight::reference

#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "basis/incident_values.h"
#include "device/buffer.h"
#include "gi/irradiance_map.h"
#include "gpu/transport_scene.h"
#include "gpu/work_queue.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "prelight/progress.h"
#include "shared/cast_types.h"
#include "shared/density_types.h"
#include "shared/gather_types.h"
#include "shared/ray_types.h"

namespace prelight {

/// Returns `count` receivers per place for FinalGather, [place][receiver], whose rays continue the place's
/// sequence.
std::vector<device::Receiver> gatherReceivers(const CompiledScene& compiled,
                                              std::span<const LightMapTexel> places, std::uint32_t count,
                                              std::uint32_t rays, std::uint64_t seed);

/// The normal of a receiver that a density query uses.
enum class AroundNormal : std::uint8_t { Geometric, Shading };

/// Returns queries of a density estimate at receivers, with a largest radius in metres. `patches`,
/// [receiver], is the result of SurfacePatches::at(); if empty, the photons of whole regions count.
std::vector<device::DensityQuery> densityQueries(std::span<const device::Receiver> receivers,
                                                 AroundNormal normal, double radius,
                                                 std::span<const std::uint32_t> patches);

/// Returns queries at places of the surface, with geometric normals.
std::vector<device::DensityQuery> densityQueries(const CompiledScene& compiled,
                                                 std::span<const LightMapTexel> places, double radius,
                                                 std::span<const std::uint32_t> patches);

/// Receivers of a final gathering that are on the device at the same time.
struct GatherBlock {
  std::size_t first = 0;     ///< index among all receivers
  std::size_t count = 0;     ///< receivers
  std::size_t rayCount = 0;  ///< rays of all these receivers
  const Buffer<device::GatherParameters>& parameters;
  const Buffer<device::CastParameters>& cast;
  const Buffer<device::Receiver>& receivers;
  Buffer<device::Ray>& rays;        ///< [receiver][ray]
  const Buffer<device::Hit>& hits;  ///< [receiver][ray], first hits, valid during meet()
  const Buffer<float>& radiances;   ///< [receiver][ray][3], valid during sum()
};

/// Strategy of a final gathering: which rays are cast, and what is made of the radiance they bring.
class GatherPattern {
 public:
  virtual ~GatherPattern() = default;

  /// Makes the rays of a block.
  virtual void makeRays(const GatherBlock& block) = 0;
  /// Called when rays have met their first surfaces.
  virtual void meet(const GatherBlock&) {}
  /// Called when the radiance of all rays is complete.
  virtual void sum(const GatherBlock& block) = 0;
};

/// Options of FinalGather.
struct GatherRequest {
  static constexpr std::uint32_t mostRaysPerReceiver = 256;

  std::uint32_t raysPerReceiver = 128;  ///< a power of two, 8 to mostRaysPerReceiver
  std::uint64_t seed = 0;
  int depth = 32;  ///< most surfaces per ray, including mirrors and glass before the last one
  /// Number of mirrors and glass surfaces after which only half of the rays continue at each further one, as
  /// few contribute much from there.
  std::uint32_t longWay = 1u << 20;
};

/// Final gathering (Jensen 2001, ch. 8): indirect irradiance at receivers from an approximation of the full
/// irradiance on the surfaces that they see. It includes everything but direct light and caustics.
class FinalGather {
 public:
  /// The arguments must outlive the object.
  FinalGather(TransportScene& scene, const IrradianceMap& irradiance, const GatherRequest& request);

  /// Returns irradiance, W/m2, [receiver]. Each receiver casts request.raysPerReceiver rays of its sequence.
  /// If given, `seen` receives the first triangle that each ray met, [receiver][ray], or
  /// PRELIGHT_NO_TRIANGLE.
  std::vector<glm::vec3> gather(std::span<const device::Receiver> receivers, Progress& progress,
                                std::vector<std::uint32_t>* seen = nullptr);

  /// Returns irradiance, W/m2, and incident radiance in SH of an order, [receiver][channel][5].
  std::vector<float> gatherIncident(std::span<const device::Receiver> receivers, Progress& progress,
                                    int order = leastIncidentOrder);

  /// Gathers with the rays of a pattern, which also stores the result.
  void gather(std::span<const device::Receiver> receivers, GatherPattern& pattern, Progress& progress);

  DeviceContext& device() const { return device_; }
  std::uint32_t raysPerReceiver() const { return request_.raysPerReceiver; }
  std::uint32_t receiversAtOnce() const { return blockSize_; }
  std::uint64_t rays() const { return rays_; }

 private:
  void prepareIncident(int order);
  /// Traces block by block, after each of which sumBlock(first, count) reads what the rays brought.
  template <typename Summing>
  void gatherBlocks(std::span<const device::Receiver> receivers, Progress& progress,
                    std::vector<float>& values, std::vector<std::uint32_t>* seen, const Summing& sumBlock);
  void setReceivers(std::span<const device::Receiver> receivers);
  void traceBlock(std::span<const device::Receiver> receivers, std::vector<std::uint32_t>* seen);
  /// Traces the active rays beyond their first surface.
  void traceOn(std::uint32_t active);
  GatherBlock blockOf(std::size_t first, std::size_t count);
  std::uint32_t collect(std::uint32_t count, std::uint32_t depth);
  void askLights(std::uint32_t count, std::uint32_t depth);
  void addArrivals(std::uint32_t shadows);

  TransportScene& scene_;
  DeviceContext& device_;
  const IrradianceMap& irradiance_;
  GatherRequest request_;
  std::uint32_t blockSize_;
  bool follows_;
  bool asksLights_;  ///< whether a lobe is rough, so that lights are sampled
  std::uint64_t rays_ = 0;
  device::GatherParameters values_{};
  Buffer<device::CastParameters> castParameters_;
  Buffer<device::GatherParameters> parameters_;
  Buffer<device::Receiver> receivers_;
  std::uint32_t mostRays_ = 0;        ///< rays of a block
  Buffer<device::Ray> rayBuffer_;     ///< [rays to trace, rays that continue (if any can)][mostRays_]
  Buffer<device::GatherPath> paths_;  ///< as rayBuffer_
  Buffer<device::Hit> hits_;
  Buffer<device::Ray> shadowRays_;  ///< [as they are made, compacted][mostRays_]
  Buffer<device::GatherArrival> arrivals_;
  Buffer<device::Hit> shadowHits_;
  Buffer<float> radiances_, sums_, incident_;
  int incidentOrder_ = 0;  ///< order of sumIncident_; 0: not built
  Buffer<std::uint8_t> marks_;
  std::optional<WorkQueue> queue_;  ///< compacts marked rays, if rays can continue

  using Parameters = Buffer<device::GatherParameters>;
  using Receivers = Buffer<device::Receiver>;
  Kernel<Buffer<device::CastParameters>, Receivers, Buffer<device::Ray>> generate_;
  Kernel<Parameters, device::GatherStep, Buffer<device::SurfaceLine>, Buffer<device::ShadingLine>,
         Buffer<device::LightLine>, Buffer<device::IrradianceLine>, Receivers, Buffer<device::Ray>,
         Buffer<device::Hit>, Buffer<device::GatherPath>, Buffer<float>, Buffer<std::uint8_t>>
      gather_;
  Kernel<Parameters, device::GatherStep, Buffer<device::SurfaceLine>, Buffer<device::ShadingLine>,
         Buffer<device::LightLine>, Receivers, Buffer<device::Ray>, Buffer<device::Hit>,
         Buffer<device::GatherPath>, Buffer<device::Ray>, Buffer<device::GatherArrival>, Buffer<std::uint8_t>>
      ask_;
  Kernel<std::uint32_t, std::uint32_t, Buffer<std::uint32_t>, Buffer<device::Hit>,
         Buffer<device::GatherArrival>, Buffer<float>>
      add_;
  Kernel<Parameters, Buffer<float>, Buffer<float>> sum_;
  Kernel<Parameters, Receivers, Buffer<device::Ray>, Buffer<float>, Buffer<float>> sumIncident_;
};

/// Casts more rays in the directions that photons came from (Jensen 1995). The irradiance is unbiased for any
/// guides.
class GuidedGather final : public GatherPattern {
 public:
  /// `guides`, [receiver][PRELIGHT_GUIDE_CELLS], are densities over the square of directions, with mean 1 and
  /// above 0 (DensityEstimator::guides). The arguments must outlive the object.
  GuidedGather(const FinalGather& gather, std::span<const float> guides, std::size_t receivers);

  void makeRays(const GatherBlock& block) override;
  void sum(const GatherBlock& block) override;

  /// Returns irradiance, W/m2, [receiver].
  const std::vector<glm::vec3>& irradiance() const { return irradiance_; }

 private:
  std::span<const float> guides_;
  std::vector<glm::vec3> irradiance_;
  Buffer<float> guideBuffer_, weights_, sums_;
  Kernel<Buffer<device::GatherParameters>, Buffer<device::Receiver>, Buffer<float>, Buffer<device::Ray>,
         Buffer<float>>
      generate_;
  Kernel<Buffer<device::GatherParameters>, Buffer<float>, Buffer<float>, Buffer<float>> sum_;
};

/// Irradiance at a receiver, W/m2.
struct BoundedIrradiance {
  glm::vec3 bounded{0.0f};  ///< of what each ray brings up to a bound
  glm::vec3 excess{0.0f};   ///< of what single rays bring beyond it
};

/// Casts the same rays as FinalGather::gather() and keeps apart what single rays bring beyond `mostOfMean`
/// times the mean of their receiver's bounded rays. The sum of both is what gather() returns, except for
/// rounding.
class BoundedGather final : public GatherPattern {
 public:
  static constexpr float mostOfMean = 16.0f;

  BoundedGather(const FinalGather& gather, std::size_t receivers);

  void makeRays(const GatherBlock& block) override;
  void sum(const GatherBlock& block) override;

  const std::vector<BoundedIrradiance>& irradiance() const { return irradiance_; }  ///< [receiver]

 private:
  std::vector<BoundedIrradiance> irradiance_;
  Buffer<float> sums_;
  Kernel<Buffer<device::CastParameters>, Buffer<device::Receiver>, Buffer<device::Ray>> generate_;
  Kernel<Buffer<device::GatherParameters>, float, Buffer<float>, Buffer<float>> sum_;
};

}  // namespace prelight

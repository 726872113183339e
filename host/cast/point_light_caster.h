#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cast/light_caster.h"
#include "cast/light_groups.h"
#include "gpu/tracer.h"

namespace prelight {

/// Light of punctual lights at receivers by shadow rays, without rays of the hemisphere.
class PointLightCaster {
 public:
  /// `lights`: punctual ones alone. `incidentOrder`: as LightCaster's. The tracer outlives it.
  PointLightCaster(const CompiledScene& scene, const GroupedLights& lights, Tracer& tracer,
                   int incidentOrder);

  /// `values` gets [receiver][3][group], or [..][value] with an incidentOrder: see LightCaster.
  void cast(std::span<const device::Receiver> receivers, std::vector<float>& values);

  std::uint32_t groupCount() const { return lights_.groupCount(); }
  std::uint64_t rays() const { return rays_; }  ///< so far

 private:
  Tracer& tracer_;
  std::uint32_t vertexCount_;
  std::uint32_t blockSize_;
  LightCaster lights_;
  Buffer<device::CastParameters> parameters_;
  Buffer<device::Receiver> receivers_;
  Buffer<device::Ray> noRays_;  ///< of the hemisphere
  Buffer<device::Hit> noHits_;
  std::vector<float> block_;
  std::uint64_t rays_ = 0;
};

}  // namespace prelight

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cast/column.h"
#include "cast/fitted_column.h"
#include "cast/light_groups.h"
#include "gpu/tracer.h"
#include "plan/shadow_sets.h"
#include "prelight/device.h"

namespace prelight {

/// Bytes that the lights of receivers that are cast at once may take on a device: as much as a bake's other
/// blocks take.
constexpr std::uint64_t lightBlockBytes(DeviceKind kind) {
  return std::uint64_t{kind == DeviceKind::Gpu ? 512u : 32u} << 20;
}

/// Numbers per group and channel: irradiance, and the bands of incident radiance where there are any.
std::size_t lightValuesOfGroup(int incidentOrder);

/// Bytes that each of them takes: its shadow rays with what they meet and bring, and the light of its groups,
/// on the device and on its way from it. `values`: of a group and channel.
std::uint64_t lightBytesPerReceiver(std::uint64_t rays, std::uint64_t groups, std::uint64_t values);

/// Bytes that a block of receivers takes at most for so many lights, of which `most` would be cast at once.
std::uint64_t lightBlockBytesOf(std::uint64_t rays, std::uint64_t groups, std::uint64_t values,
                                std::uint64_t most);

/// Receivers whose light is cast at once: `most`, or fewer where there are many lights.
std::uint32_t receiversPerLightBlock(DeviceKind kind, const GroupedLights& lights, int incidentOrder,
                                     std::uint32_t most);

/// Direct light of groups of lights at receivers: shadow rays to every light, and the hemisphere's rays that
/// meet an emitter by themselves, weighed by the balance heuristic (Veach 1997).
class LightCaster {
 public:
  /// `blockSize` receivers at most are cast at once. Receivers of a set get nothing from emitters that it
  /// leaves out. `incidentOrder`: keep the light by direction, too; 0: do not.
  LightCaster(const CompiledScene& scene, const GroupedLights& lights, const ShadowSets* sets,
              const Tracer& tracer, std::uint32_t blockSize, int incidentOrder);

  std::uint32_t groupCount() const { return layout_.groupCount; }
  bool hasEmitters() const { return hasEmitters_; }
  std::uint32_t raysPerReceiver() const { return layout_.rayCount; }

  /// Returns [receiver][3][group] until the next call: irradiance over pi, per unit of the group's colour; or
  /// [..][value], incident radiance in SH as well (basis/incident_values.h). All receivers are of the set,
  /// whose triangles the tracer holds. Where the lights have emitters, the block's hits are the closest ones.
  const Buffer<float>& cast(const CastBlockBuffers& block, std::uint32_t receivers, Tracer& tracer,
                            std::uint32_t set);

  /// The same, read back.
  void cast(const CastBlockBuffers& block, std::uint32_t receivers, Tracer& tracer, std::uint32_t set,
            std::vector<float>& values);

 private:
  DeviceContext& device_;
  device::LightGroupLayout layout_{};
  std::uint32_t valueCount_;  ///< a group and channel
  bool hasEmitters_;
  Buffer<device::LightGroupLine> lines_;
  std::vector<std::uint32_t> emittersOfSet_;  ///< [set] their first line
  DeviceScene lit_;  ///< the lights, and shading where there are emitters; surface: the tracer's
  Buffer<device::Ray> rays_;
  Buffer<device::Hit> hits_;
  Buffer<float> rayValues_;
  Buffer<float> values_;

  using Parameters = Buffer<device::CastParameters>;
  using Receivers = Buffer<device::Receiver>;
  using Rays = Buffer<device::Ray>;
  using Hits = Buffer<device::Hit>;
  Kernel<Parameters, device::LightGroupLayout, Buffer<device::LightGroupLine>, Buffer<device::SceneLayout>,
         Buffer<device::SurfaceLine>, Buffer<device::ShadingLine>, Buffer<device::LightLine>, Receivers, Rays,
         Buffer<float>>
      generate_;
  Kernel<Parameters, device::LightGroupLayout, Buffer<device::LightGroupLine>, Receivers, Rays, Hits,
         Buffer<float>, Buffer<float>>
      sum_;
  Kernel<Parameters, device::LightGroupLayout, Buffer<device::LightGroupLine>, Buffer<device::SceneLayout>,
         Buffer<device::SurfaceLine>, Buffer<device::ShadingLine>, Buffer<device::LightLine>, Receivers, Rays,
         Hits, Buffer<float>>
      addHits_;
};

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

/// Direct light of groups of lights: rows of [3][group], irradiance over pi per unit of the group's colour;
/// or [3][group][value], incident radiance in SH as well (basis/incident_values.h).
class LightColumn final : public FittedColumn {
 public:
  /// The lights outlive it. `incidentOrder`: bands of incident radiance; 0: irradiance alone.
  explicit LightColumn(const GroupedLights& lights, int incidentOrder = 0);

  std::uint32_t groups() const;

  ColumnNeeds needs() const override;
  std::uint32_t receiversAtOnce(DeviceKind kind, std::uint32_t usual) const override;
  void finish(const CastBlock& block, ColumnRows& rows) override;

 private:
  void allocate(const CastShape& shape) override;

  const GroupedLights& lights_;
  int incidentOrder_;
  std::optional<LightCaster> caster_;
};

}  // namespace prelight

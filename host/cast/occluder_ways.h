#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "cast/cast_block.h"
#include "gpu/tracer.h"
#include "scene/compiled_scene.h"
#include "shared/occluder_types.h"
#include "shared/shade_types.h"

namespace prelight {

/// [material], PRELIGHT_OCCLUDER_*.
std::vector<std::uint32_t> occluderFlags(const CompiledScene& scene);

/// The rays that go on from where a block's rays met shiny surfaces or glass: mirrored ones, to find out
/// whether that way is open (Sherif 2013, Figure 7.11), and refracted ones, until they are in free space
/// (7.2.3).
class OccluderWays {
 public:
  /// `rays`: of a block, at most. flags: occluderFlags().
  OccluderWays(const CompiledScene& scene, Tracer& tracer, const Buffer<std::uint32_t>& flags,
               std::size_t rays);

  bool hasMirrors() const { return hasMirrors_; }
  bool hasGlass() const { return hasGlass_; }

  void cast(const CastBlockBuffers& block, std::size_t rays, Tracer& tracer);

  /// Of the block that was cast last, [ray].
  const Buffer<device::OccluderWay>& mirrored() const { return mirrored_; }
  const Buffer<device::OccluderWay>& through() const { return through_; }
  /// [slot of a mirrored way]
  const Buffer<device::Hit>& mirrorHits() const { return mirrorHits_; }

  std::uint64_t rays() const { return rays_; }

 private:
  void castMirrored(const CastBlockBuffers& block, std::size_t rays, Tracer& tracer);
  void castThrough(const CastBlockBuffers& block, std::size_t rays, Tracer& tracer);
  void setSurface(cl::Kernel& kernel, cl_uint index) const;

  Tracer& surface_;
  DeviceContext& device_;
  bool hasMirrors_, hasGlass_;
  float reach_;
  std::uint64_t rays_ = 0;
  Buffer<std::uint32_t> flags_;
  Buffer<device::DeviceMaterial> bases_;
  Buffer<float> vertices_;
  Buffer<std::uint8_t> flat_;
  Buffer<device::ShadeMaterial> materials_;
  Buffer<std::uint32_t> counter_;
  Buffer<device::OccluderWay> mirrored_, through_;
  Buffer<device::Ray> mirrorRays_;
  Buffer<device::Hit> mirrorHits_, pathHits_;
  std::array<Buffer<device::Ray>, 2> pathRays_;
  std::array<Buffer<device::GlassPath>, 2> paths_;
  cl::Kernel listMirrored_, listGlass_, followGlass_;
};

}  // namespace prelight

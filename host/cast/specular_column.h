#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cast/column.h"
#include "cast/fitted_column.h"
#include "gpu/device_scene.h"
#include "gpu/medium_walker.h"
#include "gpu/tracer.h"
#include "gpu/work_queue.h"
#include "prelight/compiled_scene.h"
#include "shared/specular_types.h"

namespace prelight {

/// Where a cast's rays go on from mirrors, glass and metal (carriesSpecularly()), from rough lobes, and
/// within bodies that scatter light (scattersWithin()).
struct SpecularWays {
  bool mirrors = false;  ///< and glass and metal
  bool media = false;
  int shOrder = 0;  ///< bands of SH that light from the sky arrives in; 0: it is not summed up
  const std::vector<Image>* images =
      nullptr;          ///< Scene::images; nullptr: textures of the scattering are left out
  bool glossy = false;  ///< with mirrors: from carriesGloss(), too

  bool followed() const { return mirrors || media; }
};

/// Follows the rays of a block that meet mirrors, glass or metal or run through a body that scatters light,
/// each along one way that is drawn in proportion to what scatters there, until they leave the scene or end
/// on a diffuse surface.
class SpecularCaster {
 public:
  /// Blocks have `rays` rays at most, `raysPerReceiver` each. The tracer must outlive it.
  SpecularCaster(const CompiledScene& scene, const SpecularWays& ways, const Tracer& tracer, std::size_t rays,
                 std::uint32_t raysPerReceiver);

  /// The block's hits are the closest ones.
  void cast(const CastBlockBuffers& block, std::uint32_t receivers, Tracer& tracer);

  /// Returns the sky light, in SH, that the receivers of the last block get along the followed rays:
  /// [receiver][3][i]. The buffer is valid until the next call.
  const Buffer<float>& project(const CastBlockBuffers& block, std::uint32_t receivers);

  /// Like project() above, and reads the values back.
  void project(const CastBlockBuffers& block, std::uint32_t receivers, std::vector<float>& values);

  /// Returns where the rays of the last block have ended, [ray].
  const Buffer<device::SpecularEnd>& ends() const { return ends_; }

  /// Returns the rays cast so far.
  std::uint64_t rays() const { return rays_ + steps(); }

  /// Returns those of rays() that were cast within bodies.
  std::uint64_t steps() const { return walker_ ? walker_->rays() : 0; }

 private:
  using Parameters = Buffer<device::CastParameters>;
  using Layout = Buffer<device::SceneLayout>;
  using Surface = Buffer<device::SurfaceLine>;
  using Shading = Buffer<device::ShadingLine>;
  using Receivers = Buffer<device::Receiver>;
  using Rays = Buffer<device::Ray>;
  using Hits = Buffer<device::Hit>;
  using Paths = Buffer<device::SpecularPath>;
  using Ends = Buffer<device::SpecularEnd>;
  using Marks = Buffer<std::uint8_t>;
  using Lists = Buffer<std::uint32_t>;

  void walk(const CastBlockBuffers& block, const device::SpecularStep& step, Tracer& tracer);

  std::uint32_t raysPerReceiver_;
  std::uint32_t mostRays_;
  std::uint32_t columns_;  ///< of SH
  std::uint64_t rays_ = 0;
  DeviceScene scene_;  ///< with shading
  WorkQueue queue_;
  std::optional<MediumWalker> walker_;
  Marks specular_;  ///< [material], PRELIGHT_GOES_ON_...
  Marks marks_;
  Ends ends_;
  Rays pathRays_;  ///< [those to trace, those that go on][mostRays_]
  Hits pathHits_;
  Paths paths_;  ///< as pathRays_
  Buffer<float> shTable_, values_;
  Kernel<std::uint32_t, Layout, Surface, Marks, Hits, Ends, Marks> list_;
  Kernel<std::uint32_t, std::uint32_t, Lists, Rays, Hits, Paths, Rays, Hits> start_;
  Kernel<Parameters, device::SpecularStep, Layout, Surface, Shading, Marks, Receivers, Paths, Rays, Hits,
         Ends, Marks>
      follow_;
  Kernel<Parameters, device::SpecularStep, Layout, Surface, Shading, Receivers, Paths, Rays, Hits,
         Buffer<device::MediumWalk>, Marks>
      beginWalks_;
  Kernel<std::uint32_t, Buffer<device::MediumWalk>, Paths> endWalks_;
  Kernel<Parameters, Buffer<float>, Ends, Buffer<float>> project_;
};

/// Transfer of the light that comes from the sky by way of mirrors, glass, rough lobes and the inside of
/// bodies, in SH: rows of [3][i]. Rows of senders that stay on the device have the ends of these ways.
class SpecularColumn final : public FittedColumn {
 public:
  explicit SpecularColumn(const SpecularWays& ways);

  /// Returns whether there are rows; else rays are followed for their ends alone.
  bool hasValues() const { return rowWidth() > 0; }

  /// Returns where the rays of the block that was finished last ended, [ray].
  const Buffer<device::SpecularEnd>& ends() const { return caster_.value().ends(); }

  ColumnNeeds needs() const override {
    return {.closestHits = true, .ownRays = true, .blockedRays = hasValues()};
  }
  void finish(const CastBlock& block, ColumnRows& rows) override;
  std::unique_ptr<ColumnSums> makeSums(const SideShape& side) override;
  std::uint64_t rays() const override { return earlierRays_ + (caster_ ? caster_->rays() : 0); }
  void save(StateWriter& state) const override;
  void load(StateReader& state) override;
  void saveBlock(StateWriter& state, const CastTask& task, std::uint32_t receivers) override;
  void loadBlock(StateReader& state, const CastTask& task, std::uint32_t receivers,
                 const ColumnRows& rows) override;

  /// Returns how many of the rays were steps within bodies.
  std::uint64_t steps() const { return earlierSteps_ + (caster_ ? caster_->steps() : 0); }

 private:
  void allocate(const CastShape& shape) override;

  SpecularWays ways_;
  std::optional<SpecularCaster> caster_;
  std::uint64_t earlierRays_ = 0, earlierSteps_ = 0;  ///< of runs that load() goes on with, and of blocks
                                                      ///< of other processes
  GrownCount toldRays_, toldSteps_;
};

}  // namespace prelight

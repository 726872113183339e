#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "cast/caster.h"
#include "charts/texel_cells.h"
#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// Casts the hemispheres of a light map's texels. The rays of a texel are distributed over receivers at its
/// place or spread over its cell, which takes no more rays and smooths edges within texels.
class SpreadCaster {
 public:
  /// Returns the number of receivers for so many rays per texel, a power of two from 16 on: as many as a cell
  /// has places if each then has enough rays.
  static std::uint32_t receiversOf(std::uint32_t rays);

  /// Sets `options.raysPerReceiver` and `marksInside`. The scene, the tracer and the columns must outlive
  /// this object.
  SpreadCaster(const CompiledScene& scene, Tracer& tracer, CastOptions options, std::vector<Column*> columns,
               std::uint32_t rays, std::uint64_t seed);

  /// Callback for a receiver: the rows of its block, and its share in the mean of its texel.
  using Visit = std::function<void(std::size_t texel, std::size_t receiver, float share, const CastRows&)>;

  /// Casts from all texels, for one set of occluders of the scene, and visits each receiver that counts.
  /// Without `cells` all receivers are at the texels' places. Receivers inside objects do not count where
  /// others of their texel are outside; where all are inside, `hidden` becomes 1.
  void cast(std::span<const LightMapTexel> texels, const TexelCells* cells, std::uint32_t set,
            std::span<std::uint8_t> hidden, const Visit& visit);

  const Caster& caster() const { return caster_; }
  std::uint64_t receivers() const { return cast_; }  ///< so far

 private:
  void castBlock(std::span<const LightMapTexel> texels, const TexelCells* cells, std::uint32_t set);

  const CompiledScene& scene_;
  std::uint32_t perTexel_;
  Caster caster_;
  std::uint32_t seed_;
  std::uint64_t cast_ = 0;
  std::vector<device::Receiver> receivers_;
  CastRows rows_;
};

}  // namespace prelight

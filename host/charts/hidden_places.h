#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cast/caster.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// Finds places on a surface that lie inside objects, where nobody looks: a few rays from each, none of which
/// escapes, meet nothing but backs of one-sided surfaces.
class HiddenPlaces {
 public:
  static constexpr std::uint32_t raysPerPlace = 16;

  /// The scene, and the tracer of that scene, must outlive this object.
  HiddenPlaces(const CompiledScene& scene, Tracer& tracer, std::uint64_t seed);

  /// Sets marks[place] to 1 for places inside objects; other marks are unchanged.
  void mark(std::span<const LightMapTexel> places, std::span<std::uint8_t> marks);

 private:
  const CompiledScene& scene_;
  Caster caster_;
  std::uint32_t seed_;
  std::vector<device::Receiver> receivers_;
  CastRows cast_;
};

}  // namespace prelight

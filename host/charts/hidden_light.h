#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "cast/caster.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// Gives hidden texels the light of the darkest of their visible neighbours, ring by ring within their chart;
/// the darkest because a wall has rooms on both sides. Charts that are entirely hidden are unchanged. values:
/// [texel of the layout][length], where the first of each third is red, green and blue; hidden: [texel of the
/// layout].
void fillHidden(const LightMapLayout& layout, std::size_t length, std::span<const std::uint8_t> hidden,
                std::span<float> values);

/// As above, for a light map's texels.
void fillHidden(std::span<const std::uint8_t> hidden, LightMap& map);

/// Gives texels without any light in a light map of one coefficient that of their darkest lit neighbours,
/// ring by ring within their chart and not across walls: such texels lie below a moving object.
void fillBlack(LightMap& map);

/// Sets the values of a light map of one coefficient from those of its texels, [texel of the layout]. Texels
/// that its walls mark as inside objects take their neighbours' values.
void setIrradiance(std::span<const glm::vec3> irradiance, LightMap& map);

/// Returns the luminance of the first value of each third.
double lightOf(std::span<const float> values);

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

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// About so many places evenly over all surface that has a chart. They have numbers of their own, above those
/// of texels, and stand for themselves alone (LightMapTexel::whole is false).
std::vector<LightMapTexel> evenPlaces(const CompiledScene& scene, const LightMapLayout& layout,
                                      std::size_t count);

/// What was found at places twice, with random numbers of their own.
struct FoundTwice {
  std::array<std::vector<float>, 2> values;  ///< [place][channel]
  std::vector<std::uint8_t> hidden;          ///< [place], 1 inside an object: it does not count
};

/// How far a map is off.
struct ShownError {
  double rms = 0.0;   ///< over the places and the channels
  double mean = 0.0;  ///< of what is there
};

/// What look-ups show against what was found: the mean product of the two differences, to which the noise of
/// what was found adds nothing.
ShownError errorOfShown(const LightMap& map, std::span<const LightMapTexel> places, const FoundTwice& found);

}  // namespace prelight

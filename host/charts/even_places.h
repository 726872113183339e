#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// Returns about `count` places distributed evenly over all surface with charts. Their numbers are above
/// those of texels, and they do not represent texels (LightMapTexel::whole is false).
std::vector<LightMapTexel> evenPlaces(const CompiledScene& scene, const LightMapLayout& layout,
                                      std::size_t count);

/// Values found at places twice, with independent random numbers.
struct FoundTwice {
  std::array<std::vector<float>, 2> values;  ///< [place][channel]
  std::vector<std::uint8_t> hidden;          ///< [place] 1 inside an object: the place does not count
};

/// The error of a map.
struct ShownError {
  double rms = 0.0;   ///< over places and channels
  double mean = 0.0;  ///< mean of the values
};

/// Returns the error of look-ups relative to values found twice: the mean product of the two differences, to
/// which the noise of the values contributes nothing.
ShownError errorOfShown(const LightMap& map, std::span<const LightMapTexel> places, const FoundTwice& found);

}  // namespace prelight

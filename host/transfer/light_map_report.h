#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace prelight {

/// What people are told of texel sizes.
struct TexelSizeReport {
  double smallest = 0.0;      ///< m
  double largest = 0.0;       ///< m
  double error = 0.0;         ///< as expected, rms over the area of the charts that were judged
  std::uint32_t specks = 0;   ///< see TexelSizes
  std::uint32_t limited = 0;  ///< see TexelSizes
};

/// What baking a light map took.
struct LightMapReport {
  std::uint64_t rays = 0;
  std::optional<TexelSizeReport> sizes;  ///< where they were chosen by error
  std::size_t hidden = 0;                ///< texels inside objects
  double jumpBefore = 0.0;               ///< seamJump() before stitching, W/m2
  double jumpAfter = 0.0;
};

}  // namespace prelight

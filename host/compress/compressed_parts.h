#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "prelight/bake.h"
#include "prelight/progress.h"

namespace prelight {

/// Names of the methods in files and options, [CompressionMethod].
inline constexpr std::array<std::string_view, 6> compressionMethodNames = {"half", "band8", "pca",
                                                                           "vq",   "cpca",  "rgbe"};

/// Result of compressing one part of a bake.
struct PartCompression {
  std::string_view part;
  std::size_t floatBytes = 0;
  /// Equals `floatBytes` where the part stays as floats because the method would take more.
  std::size_t bytes = 0;
  double error = 0.0;  ///< RMS, relative to the RMS of the coefficients
};

/// Compresses the SH transfer of keys, texels and volumes of a bake and replaces their floats by the decoded
/// values that readers will get. `surface` is the area of each vertex, [vertex], which weights errors of
/// keys. Parts with fewer coefficients than the request has components get as many components as they have
/// coefficients. Light of a volume's light groups stays uncompressed. Throws Interrupted.
std::vector<PartCompression> compressParts(const CompressionRequest& request, std::span<const double> surface,
                                           Bake& bake, const Progress& progress = Progress());

/// Splits the joined transfer of all keys, one after the other, into the animation's keys.
void takeKeys(const HarmonicTransfer& all, AnimatedTransfer& animation);

}  // namespace prelight

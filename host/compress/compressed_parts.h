#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "prelight/bake.h"
#include "prelight/progress.h"

namespace prelight {

/// What compression of a part of a bake changed.
struct PartCompression {
  std::string_view part;
  std::size_t floatBytes = 0;
  std::size_t bytes = 0;  ///< `floatBytes`: it stays as it is, since the method would take more
  double error = 0.0;     ///< rms, relative to that of the coefficients
};

/// Compresses the SH transfer of keys, texels and volumes of a bake, whose floats become what its readers
/// will get. `surface`: of each vertex, [vertex], by which errors of keys count. Parts of fewer coefficients
/// than the request has components get as many as they have. Light of a volume's light groups stays as it is.
/// Throws Interrupted.
std::vector<PartCompression> compressParts(const CompressionRequest& request, std::span<const double> surface,
                                           Bake& bake, const Progress& progress = Progress());

/// Transfer of all keys, one after the other, into the animation.
void takeKeys(const HarmonicTransfer& all, AnimatedTransfer& animation);

}  // namespace prelight

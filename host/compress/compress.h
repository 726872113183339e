#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "prelight/progress.h"
#include "prelight/transfer.h"

namespace prelight {

/// Maps bytes to values: offset + scale x byte.
struct ByteRange {
  float offset = 0.0f;
  float scale = 0.0f;  ///< >= 0

  /// Returns the byte whose value is nearest.
  std::uint8_t encode(double value) const;
  double decode(std::uint8_t byte) const { return double(offset) + double(scale) * byte; }
};

/// Fits a range to values. It starts with their least and greatest and is refined in turns: each value is
/// rounded to its nearest byte, then the range follows by linear regression on the bytes. No turn raises the
/// squared error. `weights` has one entry per value.
ByteRange fitByteRange(std::span<const double> values, std::span<const double> weights);

/// Implements compress() of prelight/transfer.h. Throws Interrupted; unfinished work is kept.
CompressedTransfer compress(const HarmonicTransfer& transfer, const CompressionRequest& request,
                            std::span<const double> vertexWeights, const Progress& progress);

/// A compression, and its weighted RMS error of the vectors over their RMS.
struct BoundedCompression {
  CompressedTransfer transfer;
  double error = 0.0;
};

/// Compresses as `pca` with weights of bytes does, with as few components as keep the error of what is stored
/// at `error` or below. Returns nothing if `mostComponents` are too few. Throws Interrupted; unfinished work
/// is kept.
std::optional<BoundedCompression> compressToError(const HarmonicTransfer& transfer, double error,
                                                  int mostComponents, std::span<const double> vertexWeights,
                                                  const Progress& progress);

}  // namespace prelight

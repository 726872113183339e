#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace prelight {

/// Values as offset + scale x byte.
struct ByteRange {
  float offset = 0.0f;
  float scale = 0.0f;  ///< >= 0

  std::uint8_t encode(double value) const;
  double decode(std::uint8_t byte) const { return double(offset) + double(scale) * byte; }
};

/// The range for some values: begins with their least and greatest and is then refined by turns, bytes to the
/// nearest and the range by linear regression on the bytes, which lowers the squared error at every turn.
/// `weights` has an entry a value.
ByteRange fitByteRange(std::span<const double> values, std::span<const double> weights);

}  // namespace prelight

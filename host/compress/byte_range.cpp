#include "compress/byte_range.h"

#include <algorithm>
#include <cmath>

namespace prelight {

namespace {

double squaredError(const ByteRange& range, std::span<const double> values, std::span<const double> weights) {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double error = range.decode(range.encode(values[i])) - values[i];
    sum += weights[i] * error * error;
  }
  return sum;
}

/// Returns the weighted least-squares fit of the values over the bytes that `range` gives them.
ByteRange regression(const ByteRange& range, std::span<const double> values,
                     std::span<const double> weights) {
  double w = 0.0, x = 0.0, y = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    w += weights[i];
    x += weights[i] * range.encode(values[i]);
    y += weights[i] * values[i];
  }
  double xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double dx = range.encode(values[i]) - x / w;
    xx += weights[i] * dx * dx;
    xy += weights[i] * dx * (values[i] - y / w);
  }
  if (!(w > 0.0) || !(xx > 0.0) || !(xy > 0.0)) return range;
  const double scale = xy / xx;
  return {static_cast<float>(y / w - scale * x / w), static_cast<float>(scale)};
}

}  // namespace

std::uint8_t ByteRange::encode(double value) const {
  if (!(scale > 0.0f)) return 0;
  const double byte = std::nearbyint((value - double(offset)) / double(scale));
  return static_cast<std::uint8_t>(std::clamp(byte, 0.0, 255.0));
}

ByteRange fitByteRange(std::span<const double> values, std::span<const double> weights) {
  if (values.empty()) return {};
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  ByteRange best{static_cast<float>(*least), static_cast<float>((*greatest - *least) / 255.0)};
  double error = squaredError(best, values, weights);
  for (int turn = 0; turn < 12; ++turn) {
    const ByteRange next = regression(best, values, weights);
    const double nextError = squaredError(next, values, weights);
    if (!(nextError < error * (1.0 - 1e-4))) break;
    best = next;
    error = nextError;
  }
  return best;
}

}  // namespace prelight

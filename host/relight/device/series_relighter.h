#pragma once

#include <cstddef>
#include <span>

#include "device/buffer.h"

namespace prelight {

/// Transfer on a device that is multiplied with the coefficients of lights, again and again. A receiver is a
/// vertex, a texel or a cell of a volume.
class SeriesRelighter {
 public:
  virtual ~SeriesRelighter() = default;

  virtual std::size_t receiverCount() const = 0;

  /// Returns the bytes of transfer and radiance that one relighting reads and writes.
  virtual std::size_t bytesMoved() const = 0;

  /// Sets the light's coefficients, [channel][i], 3 x those of a channel of the transfer. Throws UsageError
  /// for another number of values.
  virtual void setLight(std::span<const double> light) = 0;

  /// Writes radiance before albedo to `radiance`, [receiver][3], which has at least 3 x receiverCount()
  /// entries. Returns before the work is done.
  virtual void relight(Buffer<float>& radiance) = 0;
};

/// Throws UsageError unless the light has three channels of `count` coefficients.
void checkSeriesLight(std::span<const double> light, std::size_t count);

}  // namespace prelight

#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "device/kernel.h"

namespace prelight {

/// Rotates functions in spherical harmonics on the device by one matrix per band: f'(w) = f(R^-1 w).
class BandRotator {
 public:
  /// The device must outlive the rotator. `order` from 1 to 32.
  BandRotator(DeviceContext& device, int order);

  /// Throws UsageError for a matrix that is not orthonormal (sh::checkRotation).
  void setRotation(const glm::dmat3& rotation);

  /// `in` and `out` are different buffers of [function][i]; the channels of a light are three functions.
  /// Returns before the work is done.
  void rotate(const Buffer<float>& in, Buffer<float>& out, std::size_t functions);

 private:
  int order_;
  Buffer<float> matrices_;
  Kernel<Buffer<float>, Buffer<float>, std::uint32_t, std::uint32_t, Buffer<float>> kernel_;
};

}  // namespace prelight

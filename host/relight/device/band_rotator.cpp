#include "relight/device/band_rotator.h"

#include <vector>

#include "basis/sh_rotation.h"

namespace prelight {

namespace {

/// Returns the sum of (2l + 1)^2 over the bands.
std::size_t matrixEntries(int order) {
  return static_cast<std::size_t>(order) * static_cast<std::size_t>(4 * order * order - 1) / 3;
}

}  // namespace

BandRotator::BandRotator(DeviceContext& device, int order)
    : order_(order),
      matrices_(device, matrixEntries(order)),
      kernel_(device, "relight/sky_kernels.cl", {}, "rotateBands") {}

void BandRotator::setRotation(const glm::dmat3& rotation) {
  const std::vector<double> matrices = sh::bandMatrices(order_, rotation);
  const std::vector<float> rounded(matrices.begin(), matrices.end());
  matrices_.write(std::span<const float>(rounded));
}

void BandRotator::rotate(const Buffer<float>& in, Buffer<float>& out, std::size_t functions) {
  kernel_.launch(functions * static_cast<std::size_t>(order_ * order_), matrices_, in,
                 static_cast<std::uint32_t>(order_), static_cast<std::uint32_t>(functions), out);
}

}  // namespace prelight

#include "relight/device/light_projector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "basis/cube_map.h"
#include "basis/quadrature.h"
#include "basis/sh.h"
#include "prelight/error.h"

namespace prelight {

namespace {

std::size_t sizeOf(int number) { return static_cast<std::size_t>(number); }

/// Returns the rotation from a frame whose polar axis is the sky's +Y to the world, as in
/// sh::projectEnvironment:
/// (x', y', z') = (z, x, y).
glm::dmat3 worldFromSkyFrame() { return {{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}; }

/// Returns the integrals over each column of the map of cos(m phi), or of sin(m phi), [m][column]; phi is the
/// azimuth about +Y from +Z towards +X.
std::vector<float> columnWaves(int width, int order, bool sine) {
  std::vector<float> waves;
  const double step = 2.0 * std::numbers::pi / width;
  for (int m = 0; m < order; ++m)
    for (int column = 0; column < width; ++column) {
      const glm::dvec3 w = Environment::direction((column + 0.5) / width, 0.5);
      const double phi = m * std::atan2(w.x, w.z);
      const double integral = m == 0 ? step : 2.0 * std::sin(0.5 * m * step) / m;
      waves.push_back(static_cast<float>((sine ? std::sin(phi) : std::cos(phi)) * integral));
    }
  return waves;
}

/// Returns the integrals over each row of the functions with m >= 0 at azimuth 0, [l (l + 1) / 2 + m][row].
std::vector<float> rowIntegrals(int height, int order) {
  const double step = std::numbers::pi / height;
  const auto nodes = gaussLegendre(6 + static_cast<int>(std::ceil(order * step)));
  std::vector<float> table(sizeOf(order) * sizeOf(order + 1) / 2 * sizeOf(height));
  parallelRanges(sizeOf(height), 16, [&](std::size_t begin, std::size_t end) {
    std::vector<double> values(sizeOf(order * order)), sums(values.size());
    for (std::size_t row = begin; row < end; ++row) {
      std::fill(sums.begin(), sums.end(), 0.0);
      for (const LineSample& node : nodes) {
        const double angle = step * (static_cast<double>(row) + 0.5 + 0.5 * node.position);
        sh::evaluate({std::sin(angle), 0.0, std::cos(angle)}, order, values);
        for (std::size_t i = 0; i < sums.size(); ++i)
          sums[i] += 0.5 * step * node.weight * std::sin(angle) * values[i];
      }
      for (int l = 0; l < order; ++l)
        for (int m = 0; m <= l; ++m)
          table[sizeOf(l * (l + 1) / 2 + m) * sizeOf(height) + row] =
              static_cast<float>(sums[sizeOf(l * (l + 1) + m)]);
    }
  });
  return table;
}

Buffer<float> upload(DeviceContext& device, const std::vector<float>& values) {
  return Buffer<float>(device, std::span<const float>(values));
}

}  // namespace

LightProjector::LightProjector(DeviceContext& device, int width, int height, int order)
    : device_(device),
      width_(width),
      height_(height),
      order_(order),
      sky_(device, 3 * sizeOf(width) * sizeOf(height)),
      cosine_(upload(device, columnWaves(width, order, false))),
      sine_(upload(device, columnWaves(width, order, true))),
      polar_(upload(device, rowIntegrals(height, order))),
      moments_(device, 6 * sizeOf(height) * sizeOf(order)),
      inSkyFrame_(device, 3 * sizeOf(order * order)),
      coefficients_(device, 3 * sizeOf(order * order)),
      toWorld_(device, order) {
  const char* file = "relight/sky_kernels.cl";
  momentsKernel_ = {device, file, {}, "skyMoments"};
  coefficientsKernel_ = {device, file, {}, "skyCoefficients"};
  cubeKernel_ = {device, file, {}, "sampleCube"};
  liftKernel_ = {device, file, {}, "liftLevel"};
  toWorld_.setRotation(worldFromSkyFrame());
  sky_.fill(0.0f);
}

void LightProjector::setSky(const Environment& sky) {
  sh::checkEnvironment(sky);
  if (sky.width != width_ || sky.height != height_)
    throw UsageError(
        "sky", fmt::format("got {} x {} texels, expected {} x {}", sky.width, sky.height, width_, height_));
  const std::size_t texels = sky.radiance.size();
  std::vector<float> planes(3 * texels);
  for (std::size_t i = 0; i < texels; ++i)
    for (std::size_t c = 0; c < 3; ++c) planes[c * texels + i] = sky.radiance[i][static_cast<int>(c)];
  sky_.write(std::span<const float>(planes));
}

void LightProjector::setRotation(const glm::dmat3& rotation) {
  toWorld_.setRotation(rotation * worldFromSkyFrame());
  rotation_ = rotation;
}

std::vector<float> LightProjector::projectSh() {
  const auto width = static_cast<std::uint32_t>(width_), height = static_cast<std::uint32_t>(height_),
             order = static_cast<std::uint32_t>(order_);
  momentsKernel_.launch(sizeOf(height_) * sizeOf(order_), sky_, cosine_, sine_, width, height, order,
                        moments_);
  coefficientsKernel_.launch(3 * sizeOf(order_ * order_), moments_, polar_, height, order, inSkyFrame_);
  toWorld_.rotate(inSkyFrame_, coefficients_, 3);
  return coefficients_.read();
}

std::vector<float> LightProjector::projectWavelets(int faceSize, int samples) {
  checkCubeFaceSize(faceSize, "faceSize");
  const std::size_t texels = cubeTexelCount(faceSize);
  const auto size = static_cast<std::uint32_t>(faceSize);
  Buffer<float> values(device_, 3 * texels);
  const auto axis = [&](int i) { return glm::vec4(glm::vec3(rotation_[i]), 0.0f); };
  cubeKernel_.launch(texels, sky_, static_cast<std::uint32_t>(width_), static_cast<std::uint32_t>(height_),
                     size, static_cast<std::uint32_t>(samples), axis(0), axis(1), axis(2), values);
  constexpr std::uint32_t images = 3 * cubeFaces;
  for (std::uint32_t half = 1; half < size; half *= 2) {
    const std::size_t blocks = size / (2 * half);
    liftKernel_.launch(images * blocks * blocks, values, images, size, half);
  }
  return values.read();
}

}  // namespace prelight

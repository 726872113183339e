#include "relight/device/open_lights.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "basis/lights/lamp_through_transfer.h"
#include "basis/sh_zonal.h"
#include "prelight/error.h"
#include "prelight/load.h"
#include "relight/device/harmonic_light.h"

namespace prelight {

namespace {

/// Returns what an open receiver gets of a light at an irradiance of 1, as factors of the Legendre
/// polynomials of the cosine between its normal and the light.
std::vector<double> openBands(const DistantLight& light, int order) {
  const auto pole = [](int l) { return std::sqrt((2.0 * l + 1.0) / (4.0 * std::numbers::pi)); };
  std::vector<double> bands;
  for (int l = 0; l < order; ++l) bands.push_back(pole(l));
  if (hasSize(light)) {
    sh::capZonal(light.halfAngle, bands);
    const double sine = std::sin(light.halfAngle);
    for (double& band : bands) band /= std::numbers::pi * sine * sine;
  }
  for (int l = 0; l < order; ++l) bands[static_cast<std::size_t>(l)] *= sh::clampedCosine(l) * pole(l);
  return bands;
}

}  // namespace

OpenLights::OpenLights(DeviceContext& device, std::vector<glm::vec3> normals, int order, bool isVisibility)
    : device_(device), normals_(std::move(normals)), order_(order), isVisibility_(isVisibility) {}

void OpenLights::clear() {
  colors_.clear();
  lit_.reset();
}

void OpenLights::add(const DistantLight& light, std::span<const float> through) {
  colors_.resize(3 * normals_.size(), 0.0f);
  const std::vector<double> bands = openBands(light, order_);
  const glm::dvec3 towards = glm::normalize(light.towards);
  const bool isSoft = light.halfAngle >= leastSoft;
  parallelRanges(normals_.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const double cosine = glm::dot(glm::dvec3(normals_[v]), towards);
      const glm::dvec3 left(through[3 * v], through[3 * v + 1], through[3 * v + 2]);
      const glm::dvec3 sum = lampThroughTransfer({towards, light.irradiance, cosine, isSoft}, left,
                                                 sh::legendreSum(bands, cosine), isVisibility_);
      for (int c = 0; c < 3; ++c) colors_[3 * v + static_cast<std::size_t>(c)] += static_cast<float>(sum[c]);
    }
  });
}

void OpenLights::upload() {
  if (colors_.empty()) return;
  lit_ = std::make_unique<DenseRelighter>(device_, DenseShape{1, 3}, std::span<const float>(colors_),
                                          ColorWrite::Add);
  lit_->setLight(std::vector<double>(3, 1.0));
}

void OpenLights::addTo(Buffer<float>& radiance) {
  if (lit_) lit_->relight(radiance);
}

std::unique_ptr<OpenLights> openLightsAt(const RelitSource& source, std::size_t vertices, int order,
                                         int channels) {
  if (source.options.scene == nullptr || vertices == 0) return nullptr;
  const std::vector<glm::vec3>& normals = source.options.scene->compiled.normals;
  if (normals.size() != vertices)
    throw InputError("RelighterOptions::scene",
                     fmt::format("it has {} vertices, the bake {}", normals.size(), vertices),
                     "give the scene of the bake");
  return std::make_unique<OpenLights>(source.device, normals, order, channels == 1);
}

}  // namespace prelight

#pragma once

#include <numbers>
#include <vector>

#include "viewer/programs/drawn_transfer.h"

namespace prelight::viewer {

/// Draws a given irradiance per vertex, whatever shines.
class StaticLight : public DrawnTransfer {
 public:
  explicit StaticLight(std::span<const glm::vec3> irradiance)
      : radiance_(Attribute::Radiance, std::span<const glm::vec3>(reflected(irradiance))) {}

  void light(const Illumination&) override {}
  bool replaceIrradiance(std::span<const glm::vec3> irradiance) override {
    radiance_.fill(std::span<const glm::vec3>(reflected(irradiance)));
    return true;
  }
  void bind(const gl::Program&) const override { radiance_.attach(); }
  void describe(const Illumination&, Warnings&) const override {}

 private:
  /// Radiance of a Lambertian surface before its albedo.
  static std::vector<glm::vec3> reflected(std::span<const glm::vec3> irradiance) {
    std::vector<glm::vec3> radiance(irradiance.begin(), irradiance.end());
    for (glm::vec3& value : radiance) value *= std::numbers::inv_pi_v<float>;
    return radiance;
  }

  VertexStream radiance_;
};

}  // namespace prelight::viewer

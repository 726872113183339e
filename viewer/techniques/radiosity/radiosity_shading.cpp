#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "prelight/error.h"
#include "techniques/radiosity/radiosity.h"
#include "viewer/programs/drawn_shading.h"
#include "viewer/programs/surface_uniforms.h"

namespace prelight::viewer {
namespace {

/// Radiance of Lambertian surfaces before their albedo.
std::vector<glm::vec3> reflected(std::span<const glm::vec3> irradiance) {
  std::vector<glm::vec3> radiance(irradiance.begin(), irradiance.end());
  for (glm::vec3& value : radiance) value *= std::numbers::inv_pi_v<float>;
  return radiance;
}

/// Draws a given irradiance per vertex, whatever shines.
class StaticLight final : public DrawnTransfer {
 public:
  explicit StaticLight(std::span<const glm::vec3> irradiance)
      : vertices_(irradiance.size()),
        radiance_(Attribute::Radiance, std::span<const glm::vec3>(reflected(irradiance))) {}

  void light(const Illumination&) override {}
  void takeLight(const FoundLight& light) override;
  void bind(const gl::Program&) const override {
    setUnknownAccessibility();
    radiance_.attach();
  }
  void describe(const Illumination&, Warnings&) const override {}

 private:
  std::size_t vertices_;
  VertexStream radiance_;
};

void StaticLight::takeLight(const FoundLight& light) {
  if (light.irradiance.empty()) return;
  if (light.irradiance.size() != vertices_)
    throw Error(ExitCode::RuntimeFailure, "irradiance",
                std::to_string(light.irradiance.size()) + " values; one for each of the scene's " +
                    std::to_string(vertices_) + " vertices is needed");
  radiance_.fill(std::span<const glm::vec3>(reflected(light.irradiance)));
}

}  // namespace

extern const DrawnShading drawnRadiosity = {
    .info = &radiosityShading,
    .make = [](const TechniqueInputs& of) -> std::unique_ptr<DrawnTransfer> {
      return std::make_unique<StaticLight>(*of.inputs.bake->irradiance);
    },
};

}  // namespace prelight::viewer

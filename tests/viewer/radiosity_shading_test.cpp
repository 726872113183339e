// Pictures of baked irradiance.
#include <gtest/gtest.h>

#include <numbers>

#include "prelight/error.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using namespace test;
using viewer::Shading;

QuadScene quadOfIrradiance(const glm::vec3& irradiance) {
  QuadScene quad;
  Material material = lambertian({0.9f, 0.7f, 0.5f});
  material.emission = {0.25f, 0.5f, 0.0f};
  quad.add(material);
  quad.lookFrom({0, 0, 2}, {0, 0, 0});
  quad.scene.lights = {makeLight(LightType::Point, {10, 10, 10}, {0, 0, 3})};
  quad.compile();
  quad.bake.irradiance.emplace(4, irradiance);
  return quad;
}

TEST(RadiosityShading, Picture_IsAlbedoTimesIrradianceOverPiPlusEmission) {
  const float pi = std::numbers::pi_v<float>;
  expectColor(pixelAt(quadOfIrradiance({pi, 2 * pi, 4 * pi}).render(square(Shading::Radiosity))),
              {0.9 + 0.25, 1.4 + 0.5, 2.0}, 1e-5);
}

TEST(RadiosityShading, FileWithIrradianceAlone_IsShownSo) {
  EXPECT_EQ(viewer::carriedShading(quadOfIrradiance(glm::vec3(1.0f)).bake, {}).shading, Shading::Radiosity);
}

TEST(RadiosityShading, IrradianceOfAnotherScene_IsRefused) {
  QuadScene quad = quadOfIrradiance(glm::vec3(1.0f));
  quad.bake.irradiance->pop_back();
  EXPECT_THROW(quad.render(square(Shading::Radiosity)), Error);
}

}  // namespace
}  // namespace prelight

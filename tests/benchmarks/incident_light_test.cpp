#include "benchmarks/suites/transfer/incident_light.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "encodings/encoding.h"
#include "scene/builtin/gltf_builder.h"
#include "scene/gltf/load/loader.h"
#include "support/devices.h"

namespace prelight::benchmarks {
namespace {

using std::numbers::pi;
constexpr double lampHeight = 0.5;  // metres above the ground
constexpr double intensity = 2.0;   // W/sr

/// A small diffuse ground within a box whose walls shine inwards, all alike, and a point light above it.
BenchmarkScene shiningBox() {
  GltfBuilder builder("box");
  const int ground = builder.addDiffuse("Ground", glm::vec3(0.5f));
  const int wall = builder.addEmitter("Wall", {1.0f, 2.0f, 3.0f});
  builder.addObject("Ground", makeGrid({-0.01, 0, 0.01}, {0.02, 0, 0}, {0, 0, -0.02}, 1, 1), ground);
  struct Side {
    glm::dvec3 corner, u, v;
  };
  const std::array<Side, 6> sides = {{{{-1, -1, 1}, {2, 0, 0}, {0, 0, -2}},
                                      {{-1, 1, -1}, {2, 0, 0}, {0, 0, 2}},
                                      {{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}},
                                      {{1, -1, 1}, {-2, 0, 0}, {0, 2, 0}},
                                      {{-1, -1, 1}, {0, 0, -2}, {0, 2, 0}},
                                      {{1, -1, -1}, {0, 0, 2}, {0, 2, 0}}}};
  for (std::size_t i = 0; i < sides.size(); ++i)
    builder.addObject("Wall " + std::to_string(i), makeGrid(sides[i].corner, sides[i].u, sides[i].v, 1, 1),
                      wall);
  builder.addPointLight("Light", {0.0f, static_cast<float>(lampHeight), 0.0f}, glm::vec3(1.0f), intensity);
  BenchmarkScene scene;
  Warnings warnings;
  scene.name = "box";
  scene.scene = loadScene(builder.take(), warnings);
  scene.compiled = compileScene(scene.scene, warnings);
  return scene;
}

/// Of an even sky of radiance L over the surface pi L (1 + cos) / 2, and of the lamp I cos / h^2.
TEST(IncidentLight, InAShiningBox_IsAnEvenSkyAndALamp) {
  Progress progress;
  StepCounter steps(progress, "test", 2);
  const std::vector<IncidentLight> lights = measureIncidentLight(
      shiningBox(), {.places = 2, .side = 32, .samples = 4, .seed = 3}, test::sharedDevice(), steps);
  ASSERT_EQ(lights.size(), 2u);
  for (const IncidentLight& light : lights) {
    const glm::dvec3 up(0.0, 1.0, 0.0), aside(std::sqrt(0.5), std::sqrt(0.5), 0.0);
    EXPECT_LT(glm::distance(light.frame()[2], up), 1e-6);
    const double lamp = intensity / (lampHeight * lampHeight);
    for (const glm::dvec3& normal : {up, aside})
      for (int channel = 0; channel < 3; ++channel) {
        const double wanted = 0.5 * pi * (channel + 1) * (1.0 + normal.y) + lamp * normal.y;
        EXPECT_NEAR(light.irradiance(normal)[channel], wanted, 0.02 * wanted) << channel;
      }
    // The constant band is the integral of radiance, over sqrt(4 pi).
    const std::vector<float> harmonics = light.harmonics();
    EXPECT_NEAR(harmonics[0], (2.0 * pi + lamp) / std::sqrt(4.0 * pi), 0.01 * harmonics[0]);
    EXPECT_NEAR(harmonics[2 * incidentTerms], (6.0 * pi + lamp) / std::sqrt(4.0 * pi),
                0.01 * harmonics[2 * incidentTerms]);
  }
}

}  // namespace
}  // namespace prelight::benchmarks

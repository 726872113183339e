#include "gather/indirect_light.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "lightmap/make_light_map_layout.h"
#include "lightmap/texel_receiver.h"
#include "scene/builtin.h"
#include "scene/loader.h"
#include "support/devices.h"
#include "support/materials.h"
#include "support/scenes.h"

namespace prelight::test {
namespace {

constexpr double pi = std::numbers::pi;

struct IndirectScene {
  Scene source;
  CompiledScene scene;
  std::vector<Light> lights;
  LightMapLayout layout;
  IndirectRequest request;

  std::vector<glm::vec3> gather() {
    std::vector<glm::vec3> found;
    light([&](IndirectLight& indirect, Progress& progress) {
      found = indirect.gather(layout.texels, progress);
    });
    return found;
  }

  std::vector<float> gatherIncident() {
    std::vector<float> found;
    light([&](IndirectLight& indirect, Progress& progress) {
      found = indirect.gatherIncident(layout.texels, progress);
    });
    return found;
  }

  template <typename Use>
  void light(const Use& use) {
    TransportScene transport({scene, source.images, lights}, sharedDevice());
    const DensitySurface surface =
        makeDensitySurface(scene, makeSurfaceRegions(scene, LightMapRequest{}.creaseAngle));
    Progress progress;
    IndirectLight light(scene, transport, layout, surface, request, sharedDevice(), progress);
    use(light, progress);
  }
};

IndirectScene builtinLight(const std::string& name, std::uint32_t texels) {
  IndirectScene light;
  Warnings warnings;
  light.source = loadScene(makeBuiltinScene(name), warnings);
  light.scene = compileScene(light.source, warnings);
  light.lights = light.source.lights;
  LightMapRequest map;
  map.texels = texels;
  light.layout = makeLightMapLayout(light.source, light.scene, map);
  return light;
}

double worldX(const CompiledScene& scene, std::uint32_t face) {
  const std::uint32_t t = face % scene.triangleCount();
  return static_cast<double>(scene.positions[scene.triangles[t].x].x) + scene.origin.x;
}

TEST(IndirectLight, SealedRooms_LetNothingThroughTheWall) {
  IndirectScene light = builtinLight("rooms-sealed", 4096);
  const std::vector<glm::vec3> found = light.gather();
  double lit = 0.0, dark = 0.0;
  std::size_t litCount = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double e = static_cast<double>(std::max({found[i].x, found[i].y, found[i].z}));
    if (worldX(light.scene, light.layout.texels[i].face) < 0.0) {
      lit += e;
      ++litCount;
    } else {
      dark = std::max(dark, e);
    }
  }
  ASSERT_GT(litCount, 1000u);
  EXPECT_GT(lit, 0.0);
  EXPECT_LE(dark, 1e-4 * lit / static_cast<double>(litCount));
}

/// Photons are looked for where the texels' other light is taken.
TEST(IndirectLight, Queries_LieAtTheTexelsReceivers) {
  const IndirectScene light = builtinLight("shapes", 1024);
  const auto queries = densityQueries(light.scene, light.layout.texels, 1.0);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const device::Receiver receiver = receiverAt(light.scene, light.layout.texels[i]);
    for (int k = 0; k < 3; ++k) ASSERT_EQ(queries[i].position[k], receiver.position[k]) << i;
  }
}

/// The inside of a ball of albedo 0.5 around a lamp.
IndirectScene insideOfABall() {
  IndirectScene light;
  light.scene = sphere(24, 1.0f, {0.0f, 0.0f, 0.0f});
  for (glm::uvec3& t : light.scene.triangles) std::swap(t.y, t.z);
  for (glm::vec3& n : light.scene.normals) n = -n;
  light.scene.materials[0] = lambert(0.5f);
  light.scene.triangleFlat.assign(light.scene.triangles.size(), 1);
  Light lamp;
  lamp.type = LightType::Point;
  lamp.position = {0.3, 0.2, -0.4};
  lamp.intensity = glm::vec3(1.0f);
  light.lights = {lamp};
  LightMapRequest map;
  map.texels = 2048;
  light.layout = makeLightMapLayout(light.source, light.scene, map);
  light.request.photons = 200000;
  return light;
}

/// A sphere's inside is lit evenly by what it reflects, wherever the light is: E = a / (1 - a) Phi / (4 pi
/// r2).
TEST(IndirectLight, InsideOfAWhiteBall_IsEvenAndExact) {
  IndirectScene light = insideOfABall();
  double area = 0.0;
  for (std::uint32_t t = 0; t < light.scene.triangleCount(); ++t)
    area += 0.5 * glm::length(geometricNormal(light.scene, t));
  const double expected = 4.0 * pi / area;  // a / (1 - a) = 1
  double sum = 0.0;
  const std::vector<glm::vec3> found = light.gather();
  for (const glm::vec3& e : found) {
    sum += static_cast<double>(e.x);
    EXPECT_NEAR(e.x, expected, 0.06 * expected);
  }
  EXPECT_NEAR(sum / static_cast<double>(found.size()), expected, 0.005 * expected);
}

/// From a lamp in the middle all of it shines alike: light comes evenly from half a sphere, F = 2 E, V = E n.
TEST(IndirectLight, InsideOfABallAroundALamp_ComesEvenlyFromHalfASphere) {
  IndirectScene light = insideOfABall();
  light.lights[0].position = glm::dvec3(0.0);
  light.request.rays = 512;
  const std::vector<float> found = light.gatherIncident();
  const double constant = std::sqrt(1.0 / (4.0 * pi)), linear = std::sqrt(3.0 / (4.0 * pi));
  std::array<double, 5> error{};
  for (std::size_t i = 0; i < light.layout.texels.size(); ++i) {
    const device::Receiver receiver = receiverAt(light.scene, light.layout.texels[i]);
    const double e = static_cast<double>(found[15 * i]);
    const double expected[] = {e, 2.0 * e * constant, linear * e * receiver.normal[1],
                               linear * e * receiver.normal[2], linear * e * receiver.normal[0]};
    for (std::size_t k = 1; k < 5; ++k) {
      const double off = (static_cast<double>(found[15 * i + k]) - expected[k]) / e;
      EXPECT_NEAR(off, 0.0, 0.15) << k;
      error[k] += off / static_cast<double>(light.layout.texels.size());
    }
  }
  for (std::size_t k = 1; k < 5; ++k) EXPECT_NEAR(error[k], 0.0, 0.01) << k;
}

}  // namespace
}  // namespace prelight::test

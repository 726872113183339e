#include "gi/global_illumination.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/devices.h"
#include "support/materials.h"
#include "support/scenes.h"

namespace prelight::test {
namespace {

TEST(GlobalIllumination, DarkMirror_WeakensCausticPhotonsAndEndsNone) {
  Warnings warnings;
  const Scene source = loadScene(makeBuiltinScene("caustics"), warnings);
  CompiledScene scene = compileScene(source, warnings);
  for (CompiledMaterial& material : scene.materials)
    if (material.metallic > 0.5f) material = metal(0.1f, 0.0f);
  const LitScene lit{scene, noImages(), source.lights};
  GlobalIlluminationRequest request;
  request.indirect.photons = 1000;
  request.causticPhotons = 20000;
  Progress progress;
  const GlobalIllumination light =
      computeGlobalIllumination(source, lit, request, 8192, sharedDevice(), progress);
  const PhotonPower& power = light.causticPhotons.power;
  const double sent = power.watts(power.emitted).x / double(light.causticPhotons.emitted);
  const auto weak = std::count_if(light.photons.begin(), light.photons.end(),
                                  [&](const device::Photon& p) { return p.power[0] < 0.2 * sent; });
  EXPECT_GT(weak, 100);
}

/// The walls of a room turn their backs to a lamp inside. With albedo 1/2, their reflected light adds up to
/// the lamp's power.
TEST(GlobalIllumination, RoomSeenFromBehindItsWalls_GathersItsGeometricSeries) {
  CompiledScene scene = box(1, glm::vec3(-1.0f), glm::vec3(1.0f), false);
  scene.materials[0] = lambert(0.5f);
  Light lamp;
  lamp.position = {0.2, 0.1, -0.3};
  lamp.intensity = glm::vec3(1.0f);
  const LitScene lit{scene, noImages(), {lamp}};
  Progress progress;
  GlobalIlluminationRequest request;
  request.indirect.directByPhotons = true;
  const GlobalIllumination light =
      computeGlobalIllumination(Scene{}, lit, request, 8192, sharedDevice(), progress);
  double sum = 0.0, count = 0.0;
  for (const LightMapTexel& texel : light.indirect.layout.texels) {
    if (texel.face < scene.triangleCount()) continue;
    sum += static_cast<double>(light.indirect.values[3 * std::size_t{texel.texel}]);
    ++count;
  }
  ASSERT_GT(count, 1000.0);
  const double expected = 4.0 * std::numbers::pi / 24.0;
  EXPECT_NEAR(sum / count, expected, 0.02 * expected);
}

}  // namespace
}  // namespace prelight::test

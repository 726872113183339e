#include "full/full_light.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/builtin.h"
#include "scene/loader.h"
#include "support/devices.h"
#include "support/materials.h"
#include "support/scenes.h"

namespace prelight::test {
namespace {

TEST(FullLight, DarkMirror_WeakensCausticPhotonsAndEndsNone) {
  Warnings warnings;
  const Scene source = loadScene(makeBuiltinScene("caustics"), warnings);
  CompiledScene scene = compileScene(source, warnings);
  for (CompiledMaterial& material : scene.materials)
    if (material.metallic > 0.5f) material = metal(0.1f, 0.0f);
  const LitScene lit{scene, noImages(), source.lights};
  FullLightRequest request;
  request.indirect.photons = 1000;
  request.causticPhotons = 20000;
  Progress progress;
  const FullLight light = makeFullLight(source, lit, request, sharedDevice(), progress);
  const PhotonPower& power = light.causticPhotons.power;
  const double sent = power.watts(power.emitted).x / double(light.causticPhotons.emitted);
  const auto weak = std::count_if(light.photons.begin(), light.photons.end(),
                                  [&](const device::Photon& p) { return p.power[0] < 0.2 * sent; });
  EXPECT_GT(weak, 100);
}

}  // namespace
}  // namespace prelight::test

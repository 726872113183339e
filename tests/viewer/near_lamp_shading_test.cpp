#include <gtest/gtest.h>

#include <numbers>

#include "basis/sh_zonal.h"
#include "compress/half_float.h"
#include "prelight/picture.h"
#include "transfer/near_lamps.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using test::expectColor;
using test::pixelAt;
using test::QuadScene;
using test::square;
using viewer::Shading;

constexpr auto lampPi = static_cast<float>(std::numbers::pi);
constexpr int shellBands = 4;

/// A white quad that faces +Z in a scene 6 m deep, lit by a lamp above its middle, seen from aslant. Shells:
/// the first blocks `blocked` of all of the hemisphere's light.
glm::vec3 lampOver(double distance, double blocked, bool withShells, Shading shading = Shading::Sh) {
  QuadScene quad;
  quad.add(test::lambertian(glm::vec3(1)), 0.02f);
  quad.add(test::lambertian(glm::vec3(1)), 2.0f, glm::translate(glm::dmat4(1.0), {0, 0, 6}));
  quad.lookFrom({0.02, 0, 0.1}, {0, 0, 0});
  quad.scene.lights = {
      test::makeLight(LightType::Point, glm::vec3(lampPi * float(distance * distance)), {0, 0, distance})};
  quad.setSky(constantEnvironment(glm::vec3(0)));
  quad.compile();
  quad.bakeOpen(3);
  quad.bake.ch = quad.bake.sh;
  if (withShells) {
    NearLampTransfer lamps{shellBands, 2, 0.1, 10.0, {}};
    std::vector<double> open(lamps.columns());
    sh::openTransfer({0, 0, 1}, shellBands, open);
    for (std::uint32_t v = 0; v < quad.compiled.vertexCount(); ++v)
      for (int shell = 0; shell < 2; ++shell)
        for (const double value : open)
          lamps.halves.push_back(toHalf(shell == 0 ? static_cast<float>(blocked * value) : 0.0f));
    quad.bake.nearLamps = lamps;
  }
  return pixelAt(quad.render(square(shading)));
}

TEST(NearLampShading, LampBehindWhatBlocks_IsDark) {
  expectColor(lampOver(5.0, 1.0, false), glm::dvec3(1), 2e-3);
  expectColor(lampOver(5.0, 1.0, true), glm::dvec3(0), 1e-6);
  expectColor(lampOver(5.0, 1.0, true, Shading::Ch), glm::dvec3(0), 1e-6);
}

TEST(NearLampShading, LampBeforeWhatBlocks_IsAsWithoutShells) {
  const glm::vec3 plain = lampOver(0.15, 1.0, false);
  expectColor(lampOver(0.15, 1.0, true), glm::dvec3(plain), 1e-5);
}

TEST(NearLampShading, PartOfAShell_IsWhatTheHostFinds) {
  const NearLampTransfer range{1, 2, 0.1, 10.0, {}};
  for (const double blocked : {0.5, 0.7}) {
    const double visibility = 1.0 - blocked * shareBefore(range, 0, 2.0);
    ASSERT_LT(sharpened(visibility), 1.0);
    expectColor(lampOver(2.0, blocked, true),
                sharpened(visibility) * glm::dvec3(lampOver(2.0, blocked, false)), 4e-3);
  }
}

TEST(NearLampShading, PhongAndAo_HaveNoShadowsOfShells) {
  const glm::vec3 plain = lampOver(5.0, 1.0, false, Shading::Phong);
  expectColor(lampOver(5.0, 1.0, true, Shading::Phong), glm::dvec3(plain), 1e-6);
}

}  // namespace
}  // namespace prelight

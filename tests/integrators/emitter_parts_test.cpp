#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gpu/light_tables.h"
#include "support/screen_scene.h"
#include "support/shot.h"

// Emitters with uneven textures: paths choose among their parts.
namespace prelight::test {
namespace {

using reference::Estimator;
using std::numbers::pi;

/// A white floor below a screen, seen through the gap between them.
Shot floorBelow(const Image& image, double x, std::uint64_t samples) {
  Scene source = screenScene(image);
  Primitive floor;
  floor.positions = {{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}};
  floor.texCoords0.assign(4, glm::vec2(0.0f));
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  floor.material = 1;
  Material white;
  white.metallic = white.specular = 0.0f;
  source.materials.push_back(white);
  source.meshes.push_back({"floor", {floor}});
  MeshNode node;
  node.mesh = node.node = 1;
  node.transforms = {glm::dmat4(1.0)};
  source.nodes.emplace_back();
  source.meshNodes.push_back(node);
  Shot shot = shotOf(compiledOf(source), orthographicCamera({x, 1.5, 0}, {x, 0, 0}, 0.01), 4, samples);
  shot.images = source.images;
  shot.request.depth = 2;
  return shot;
}

/// Radiance of the floor at `x` under a screen whose emission depends on the share of its width.
double radianceBy(double x, double (*emitted)(double)) {
  double sum = 0.0;
  constexpr int steps = 256;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double u = (i + 0.5) / steps, z = (j + 0.5) / steps - 0.5;
      const glm::dvec3 way(2.0 * u - 1.0 - x, 2.0, z);
      sum += emitted(u) * way.y * way.y / std::pow(glm::dot(way, way), 2.0) * 2.0 / (steps * steps);
    }
  return double(screenRadiance) * sum / pi;
}

TEST(EmitterParts, ScreenLitInItsLeftQuarter_AllWaysToFindItAgree) {
  // The emission is interpolated linearly between centres of the 64 texels, across the edge of the image as
  // well, because it repeats.
  const auto emitted = [](double u) {
    const double column = 64.0 * u - 0.5, low = std::floor(column);
    const auto lit = [](double texel) { return std::fmod(texel + 64.0, 64.0) < 16.0 ? 1.0 : 0.0; };
    return std::lerp(lit(low), lit(low + 1.0), column - low);
  };
  for (const double x : {-0.8, 0.8}) {
    const double expected = radianceBy(x, emitted);
    for (const Estimator estimator : {Estimator::Both, Estimator::LightsOnly, Estimator::ScatterOnly}) {
      Shot shot = floorBelow(leftQuarter(64, 32), x, estimator == Estimator::ScatterOnly ? 8192 : 512);
      shot.request.estimator = estimator;
      const MeanAndError found = meanOf(shot.render());
      EXPECT_NEAR(found.mean, expected, 4.0 * found.error + 3e-3 * expected) << x << " " << int(estimator);
    }
  }
}

// If dark texels were sampled, they would cause most of the noise.
TEST(EmitterParts, ScreenLitInItsLeftQuarter_IsSampledWhereItShines) {
  const auto noiseOf = [](const Image& image) {
    Shot shot = floorBelow(image, -0.5, 256);
    shot.request.estimator = Estimator::LightsOnly;
    const MeanAndError found = meanOf(shot.render());
    return found.error / found.mean;
  };
  EXPECT_LT(noiseOf(leftQuarter(64, 32)), 1.2 * noiseOf({}));
}

TEST(EmitterParts, RandomTexels_KeepTheMean) {
  const auto foundBy = [](Estimator estimator) {
    Shot shot = floorBelow(noiseImage(16, 16), 0.0, 4096);
    shot.request.estimator = estimator;
    return meanOf(shot.render());
  };
  const MeanAndError sampled = foundBy(Estimator::LightsOnly), met = foundBy(Estimator::ScatterOnly);
  EXPECT_NEAR(sampled.mean, met.mean, 4.0 * std::hypot(sampled.error, met.error));
  EXPECT_LT(met.error, 0.02 * met.mean);
}

TEST(EmitterTables, OfPartsAndWholes_TellAsMuchPower) {
  const CompiledScene parts = compiledOf(screenScene(leftQuarter(64, 32))),
                      whole = compiledOf(screenScene({}));
  const LightTables a = makeLightTables(parts, {}, nullptr, true),
                    b = makeLightTables(whole, {}, nullptr, true);
  EXPECT_NEAR(a.emitterPower, 0.25 * b.emitterPower, 1e-5 * b.emitterPower);
  EXPECT_TRUE(b.emitterParts.empty());
  EXPECT_EQ(emitterRuns(a).size(), 2u);
}

}  // namespace
}  // namespace prelight::test

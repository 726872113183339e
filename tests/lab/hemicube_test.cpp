#include "benchmarks/lab/hemicube.h"

#include <gtest/gtest.h>

#include "radiosity/form_factors.h"
#include "support/devices.h"
#include "support/scenes.h"

namespace prelight {
namespace {

TEST(Hemicube, Pixels_AreTheHemisphereWeightedByTheCosine) {
  const std::vector<HemicubePixel> pixels = makeHemicube(64);
  EXPECT_EQ(pixels.size(), 3u * 64 * 64);
  double sum = 0.0, cosine = 0.0;
  glm::dvec3 mean(0.0);
  for (const HemicubePixel& pixel : pixels) {
    EXPECT_GT(pixel.direction.z, 0.0);
    sum += pixel.share;
    cosine += pixel.share * pixel.direction.z;
    mean += pixel.share * pixel.direction;
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_NEAR(cosine, 2.0 / 3.0, 1e-4);  // The mean cosine of cosine-distributed directions.
  EXPECT_NEAR(mean.x, 0.0, 1e-12);
  EXPECT_NEAR(mean.y, 0.0, 1e-12);
}

TEST(Hemicube, ParallelPlates_AreTheClosedFormAndWhatTheCastFinds) {
  CompiledScene scene = test::sceneOf({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, {{0, 1, 2}, {0, 2, 3}});
  test::append(scene, test::sceneOf({{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}, {{0, 1, 2}, {0, 2, 3}}));
  const RadiosityElements elements = makeElements(scene, 0.3);
  Tracer tracer(scene, test::sharedDevice());
  const ElementPoints points(scene, elements, 1);
  HemicubeCast hemicube(scene, elements, tracer, 32);
  double sum = 0.0;
  for (std::uint32_t e = 0; e < elements.perSide() / 2; ++e)
    for (const auto& [met, share] : hemicube.row(points, e, 4)) {
      EXPECT_GE(met, elements.perSide() / 2);
      sum += share;
    }
  EXPECT_NEAR(sum / (elements.perSide() / 2) / 0.199825, 1.0, 0.005);
}

}  // namespace
}  // namespace prelight

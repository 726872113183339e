#include "benchmarks/suites/indirect/lightmaps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "charts/make_light_map_layout.h"
#include "support/devices.h"

namespace prelight::benchmarks {
namespace {

BakeRequest requestOf(double error) {
  BakeRequest request;
  request.lightMap.wanted = true;
  request.effort.rays = 256;
  request.lightMap.photons = 1u << 17;
  request.lightMap.error = error;
  return request;
}

/// A map that holds a linear function is off by nothing; one that holds 1.1 times it, by a tenth.
TEST(LightMapError, OfAMapThatIsATenthTooBright_IsATenth) {
  const BenchmarkScene scene = loadBuiltinScene("cornell");
  LightMap map;
  map.layout = makeLightMapLayout(scene.scene, scene.compiled, LightMapLayoutRequest{});
  map.values.assign(3 * map.layout.texelCount(), 1.1f);
  SurfaceLight light;
  for (const LightMapTexel& texel : map.layout.texels) {
    light.places.push_back(texel);
    light.weights.push_back(1.0);
  }
  for (std::size_t i = 0; i < 2; ++i) light.light[i].assign(3 * light.places.size(), 1.0f);
  EXPECT_NEAR(errorOfLightMap(map, map, light), 0.1, 1e-5);
}

/// The error that sizes are chosen by is the error that a map has, at places that had no part in the choice.
TEST(LightMapError, OfSizesChosenByError_IsAboutWhatWasAskedFor) {
  Progress progress;
  for (const auto& [name, error] : {std::pair<std::string, double>{"cornell", 0.06}, {"rooms", 0.1}}) {
    const BenchmarkScene scene = loadBuiltinScene(name);
    BakeRequest truth = requestOf(0.0);
    truth.effort.rays = 1024;
    const SurfaceLight light = lightOfSurface(scene, 10000, truth, test::sharedDevice(), progress);
    const auto bake = [&, error = error](std::uint64_t seed) {
      BakeRequest request = requestOf(error);
      request.seed = seed;
      return timedBake(scene, request, test::sharedDevice(), progress);
    };
    const TimedBake run = bake(0), again = bake(1);
    const double found = errorOfLightMap(*run.bake.lightMap, *again.bake.lightMap, light);
    EXPECT_LT(found, 1.25 * error) << name;
    EXPECT_GT(found, 0.4 * error) << name;
    EXPECT_NEAR(found, run.report.lightMap->sizes->error, 0.4 * found) << name;
  }
}

}  // namespace
}  // namespace prelight::benchmarks

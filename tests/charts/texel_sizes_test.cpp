#include "charts/texel_sizes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "charts/layout_places.h"
#include "charts/light_map_lookup.h"
#include "charts/texel_cells.h"
#include "support/scenes.h"

// Texel sizes for light that is known in closed form.
namespace prelight {
namespace {

using Light = std::function<double(const glm::dvec3&)>;

double even(const glm::dvec3&) { return 3.0; }
double parabola(const glm::dvec3& p) { return 1.0 + p.x * p.x; }
/// A shadow's edge that is oblique to the texels.
double edge(const glm::dvec3& p) { return p.x + 0.37 * p.z < 0.1 ? 1.0 : 0.2; }

/// A pair of pilots whose noise has a standard deviation of `noise`, relative to the light.
PilotSource sourceOf(const CompiledScene& scene, const Light& light, double noise = 0.0) {
  return [=, &scene, random = std::mt19937(7)](const LightMapLayout& layout) mutable {
    std::normal_distribution<double> normal(1.0, noise > 0.0 ? noise : 1.0);
    PilotLight pilot;
    pilot.hidden.assign(layout.texels.size(), 0);
    for (std::vector<float>& values : pilot.irradiance)
      for (const LightMapTexel& texel : layout.texels)
        for (int c = 0; c < 3; ++c)
          values.push_back(static_cast<float>(light(test::positionOf(scene, texel)) *
                                              (noise > 0.0 ? normal(random) : 1.0)));
    return pilot;
  };
}

LightMapCharts chartsOf(const CompiledScene& scene) { return makeLightMapCharts(Scene{}, scene, {}); }

TexelSizes sizesFor(const CompiledScene& scene, const LightMapCharts& charts, double error,
                    const PilotSource& source, double finest = 0.0) {
  Progress progress;
  return chooseTexelSizes(scene, charts, {error, finest > 0.0 ? finest : 0.25 * charts.texelSize}, source,
                          progress);
}

/// Rms error of a map with one texel size at random places of a square of half side 1, relative to the
/// light's mean.
double errorOfMap(const CompiledScene& scene, const LightMapCharts& charts, double size, const Light& light) {
  const LightMapLayout layout =
      layOutLightMap(scene, charts, std::vector<double>(charts.charts.size(), size));
  LightMap map;
  map.layout = layout;
  map.values.assign(3 * layout.texelCount(), 0.0f);
  const TexelCells cells(scene, layout);
  for (const LightMapTexel& texel : layout.texels)
    for (const LightMapTexel& place : cells.around(texel))
      map.values[3 * texel.texel] +=
          static_cast<float>(light(test::positionOf(scene, place)) / double(TexelCells::placeCount));
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform;
  double squares = 0.0, sum = 0.0;
  constexpr int places = 20000;
  for (int i = 0; i < places; ++i) {
    LightMapTexel place{0, static_cast<std::uint32_t>(i % 2), uniform(random), uniform(random)};
    if (place.b1 + place.b2 > 1.0f) place.b1 = 1.0f - place.b1, place.b2 = 1.0f - place.b2;
    const double there = light(test::positionOf(scene, place));
    squares += std::pow(lightMapIrradiance(map, place.face, place.b1, place.b2).x - there, 2);
    sum += there;
  }
  return std::sqrt(squares / places) / (sum / places);
}

TEST(TexelSizes, EvenLight_TakesTheCoarsestTexels) {
  const CompiledScene scene = test::ground(1, 1.0f);
  const LightMapCharts charts = chartsOf(scene);
  const TexelSizes sizes = sizesFor(scene, charts, 0.01, sourceOf(scene, even));
  ASSERT_EQ(sizes.sizes.size(), 1u);
  EXPECT_GE(sizes.sizes[0], 60.0 * charts.texelSize);
  EXPECT_LT(sizes.errors[0], 1e-6);
  EXPECT_EQ(sizes.limited, 0u);
}

// Linear interpolation of x^2 between places h apart is off by h^2 s (1 - s). Texels are means over cells,
// which exceed their centres by (0.8 h)^2 / 12. Together the rms is h^2 times sqrt(1/30 + 0.64/36 +
// 0.4096/144).
TEST(TexelSizes, Parabola_TakesTheSizeOfItsSecondDerivative) {
  const CompiledScene scene = test::ground(1, 1.0f);
  const LightMapCharts charts = chartsOf(scene);
  constexpr double mean = 4.0 / 3.0;
  for (const double error : {3e-4, 1e-3, 1e-2}) {
    const double expected = std::sqrt(error * mean / 0.2323);
    const TexelSizes sizes = sizesFor(scene, charts, error, sourceOf(scene, parabola));
    // Sizes come in steps of half an octave and are rounded to whole texels.
    EXPECT_LT(sizes.sizes[0], 1.06 * expected) << error;
    EXPECT_GT(sizes.sizes[0], 0.94 * expected / std::sqrt(2.0)) << error;
  }
}

TEST(TexelSizes, ShadowEdge_IsAsFarOffAsAskedForAndNotMuchLess) {
  const CompiledScene scene = test::ground(1, 1.0f);
  const LightMapCharts charts = chartsOf(scene);
  for (const double error : {0.15, 0.08, 0.05}) {
    const TexelSizes sizes = sizesFor(scene, charts, error, sourceOf(scene, edge));
    const double found = errorOfMap(scene, charts, sizes.sizes[0], edge);
    EXPECT_LT(found, 1.15 * error);
    EXPECT_GT(found, 0.7 * error);
    EXPECT_NEAR(sizes.errors[0], found, 0.2 * found) << error;
  }
}

TEST(TexelSizes, NoiseOfPilots_DoesNotChangeTheSizeMuch) {
  const CompiledScene scene = test::ground(1, 1.0f);
  const LightMapCharts charts = chartsOf(scene);
  const double quiet = sizesFor(scene, charts, 0.01, sourceOf(scene, parabola)).sizes[0];
  const double step = std::sqrt(2.0);
  for (const double noise : {0.01, 0.03, 0.1}) {
    const double noisy = sizesFor(scene, charts, 0.01, sourceOf(scene, parabola, noise)).sizes[0];
    EXPECT_LT(noisy, 1.01 * step * quiet) << noise;
    // Noise of up to ten times the permitted error is told from light by smaller texels alone.
    if (noise < 0.1) {
      EXPECT_GT(noisy, 0.99 * quiet / step) << noise;
    }
  }
}

TEST(TexelSizes, TexelsAreNotFinerThanAllowed_AndItIsTold) {
  const CompiledScene scene = test::ground(1, 1.0f);
  const LightMapCharts charts = chartsOf(scene);
  const TexelSizes sizes = sizesFor(scene, charts, 0.01, sourceOf(scene, edge), 0.05);
  EXPECT_EQ(sizes.sizes[0], 0.05);
  EXPECT_EQ(sizes.limited, 1u);
  EXPECT_GT(sizes.errors[0], 0.01);
}

TEST(TexelSizes, OnlyTheWallWithTheShadow_HasFineTexels) {
  const CompiledScene scene = test::box(1, glm::vec3(-1.0f), glm::vec3(1.0f), true);
  const LightMapCharts charts = chartsOf(scene);
  ASSERT_EQ(charts.charts.size(), 6u);
  const Light light = [](const glm::dvec3& p) { return p.y < -1.0 + 1e-12 ? edge(p) : 1.0; };
  const TexelSizes sizes = sizesFor(scene, charts, 0.05, sourceOf(scene, light));
  for (std::size_t c = 0; c < 6; ++c) {
    const bool floor = scene.positions[scene.triangles[charts.charts[c].triangles[0]].x].y < 0.0f &&
                       scene.positions[scene.triangles[charts.charts[c].triangles[0]].y].y < 0.0f &&
                       scene.positions[scene.triangles[charts.charts[c].triangles[0]].z].y < 0.0f;
    if (floor)
      EXPECT_LT(sizes.sizes[c], 4.0 * charts.texelSize);
    else
      EXPECT_GT(sizes.sizes[c], 50.0 * charts.texelSize);
  }
}

TEST(TexelSizes, DarkWall_IsNotJudgedByWhatCannotBeSeenOfIt) {
  const CompiledScene scene = test::box(1, glm::vec3(-1.0f), glm::vec3(1.0f), true);
  const LightMapCharts charts = chartsOf(scene);
  const Light light = [](const glm::dvec3& p) { return p.y < -1.0 + 1e-12 ? 1e-3 * edge(p) : 1.0; };
  const TexelSizes sizes = sizesFor(scene, charts, 0.05, sourceOf(scene, light));
  for (const double size : sizes.sizes) EXPECT_GT(size, 50.0 * charts.texelSize);
}

TEST(TexelSizes, PlacesInsideObjects_DoNotCount) {
  const CompiledScene scene = test::ground(1, 1.0f);
  const LightMapCharts charts = chartsOf(scene);
  const PilotSource dark = sourceOf(scene, [](const glm::dvec3& p) { return p.x < 0.1 ? 1.0 : 0.0; });
  const PilotSource source = [&](const LightMapLayout& layout) {
    PilotLight pilot = dark(layout);
    for (std::size_t t = 0; t < layout.texels.size(); ++t)
      pilot.hidden[t] = pilot.irradiance[0][3 * t] == 0.0f ? 1 : 0;
    return pilot;
  };
  EXPECT_GT(sizesFor(scene, charts, 0.02, source).sizes[0], 50.0 * charts.texelSize);
  EXPECT_LT(sizesFor(scene, charts, 0.1, dark).sizes[0], 8.0 * charts.texelSize);
}

TEST(TexelSizes, ChartsOfFewTexels_KeepTheUsualSize) {
  CompiledScene scene = test::ground(1, 1.0f);
  test::append(scene, test::ground(1, 0.002f, 0.5f));
  const LightMapCharts charts = chartsOf(scene);
  ASSERT_EQ(charts.charts.size(), 2u);
  const TexelSizes sizes = sizesFor(scene, charts, 0.02, sourceOf(scene, even));
  EXPECT_EQ(sizes.specks, 1u);
  EXPECT_EQ(std::min(sizes.sizes[0], sizes.sizes[1]), charts.texelSize);
  const TexelSizeReport report = reportOf(sizes, charts);
  EXPECT_EQ(report.smallest, charts.texelSize);
  EXPECT_EQ(report.largest, std::max(sizes.sizes[0], sizes.sizes[1]));
}

TEST(TexelSizes, Darkness_TakesTheCoarsestTexels) {
  const CompiledScene scene = test::ground(1, 1.0f);
  const LightMapCharts charts = chartsOf(scene);
  const TexelSizes sizes =
      sizesFor(scene, charts, 0.01, sourceOf(scene, [](const glm::dvec3&) { return 0.0; }));
  EXPECT_GT(sizes.sizes[0], 50.0 * charts.texelSize);
  EXPECT_EQ(sizes.errors[0], 0.0);
}

}  // namespace
}  // namespace prelight

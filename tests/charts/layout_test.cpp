#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <random>
#include <set>

#include "charts/check_layout.h"
#include "charts/make_light_map_layout.h"
#include "prelight/error.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using test::checkLayout;
using test::LayoutFigures;

struct Made {
  LightMapCharts charts;
  LightMapLayout layout;
};

Made make(const Scene& scene, const CompiledScene& compiled, const LightMapLayoutRequest& request = {}) {
  Made made;
  made.charts = makeLightMapCharts(scene, compiled, request);
  made.layout = layOutLightMap(compiled, made.charts);
  return made;
}

LayoutFigures check(const Made& made, const CompiledScene& scene, const std::string& name) {
  const LayoutFigures figures = checkLayout(scene, made.layout, made.charts.texelSize, name);
  std::cout << name << ": " << scene.triangleCount() << " triangles, " << made.charts.charts.size()
            << " charts, " << made.layout.width << " x " << made.layout.height << ", used " << figures.used
            << ", area ratio " << figures.leastRatio << " to " << figures.mostRatio << ", stretched "
            << figures.stretched << "\n";
  return figures;
}

std::size_t facesWithChart(const LightMapLayout& layout) {
  return layout.chartOf.size() - static_cast<std::size_t>(std::count(
                                     layout.chartOf.begin(), layout.chartOf.end(), LightMapLayout::noChart));
}

/// Scenes made from arrays have no Scene behind them, and thus no texture coordinates.
Made make(const CompiledScene& compiled, const LightMapLayoutRequest& request = {}) {
  return make(Scene{}, compiled, request);
}

double processSeconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

TEST(LightMapLayout, BuiltinScenes_HoldEveryProperty) {
  for (const BuiltinScene& builtin : builtinScenes()) {
    Warnings warnings;
    const Scene scene = loadScene(makeBuiltinScene(builtin.name), warnings);
    const CompiledScene compiled = compileScene(scene, warnings);
    const Made made = make(scene, compiled);
    const LayoutFigures figures = check(made, compiled, builtin.name);
    EXPECT_GE(figures.used, 0.7) << builtin.name;
    EXPECT_GE(figures.leastRatio, 0.45) << builtin.name;
    EXPECT_LE(figures.mostRatio, 2.0) << builtin.name;
    for (std::uint32_t t = 0; t < compiled.triangleCount(); ++t) {
      const CompiledMaterial& material = compiled.materials[compiled.triangleMaterials[t]];
      EXPECT_EQ(made.layout.chartOf[t] != LightMapLayout::noChart, hasLight(material, false));
      EXPECT_EQ(made.layout.chartOf[compiled.triangleCount() + t] != LightMapLayout::noChart,
                hasLight(material, true));
    }
  }
}

TEST(LightMapLayout, WideMetals_HaveChartsWhereTheyAreAskedFor) {
  for (const float roughness : {0.2f, 0.9f}) {
    CompiledScene metal = test::box(2, {-1, -1, -1}, {1, 1, 1}, true);
    metal.materials[0].albedo = glm::vec3(0.0f);
    metal.materials[0].metallic = 1.0f;
    metal.materials[0].roughness = roughness;
    LightMapLayoutRequest request;
    const auto charted = [&] {
      const LightMapLayout layout = make(metal, request).layout;
      return std::count_if(layout.chartOf.begin(), layout.chartOf.begin() + metal.triangleCount(),
                           [](std::uint32_t chart) { return chart != LightMapLayout::noChart; });
    };
    EXPECT_EQ(charted(), 0);
    request.wideMetals = true;
    EXPECT_EQ(charted(), roughness > 0.3f ? static_cast<std::ptrdiff_t>(metal.triangleCount()) : 0);
  }
}

/// The environment variable PRELIGHT_MODELS names a folder of glTF files.
TEST(LightMapLayout, Models_HoldEveryProperty) {
  const char* folder = std::getenv("PRELIGHT_MODELS");
  if (folder == nullptr) GTEST_SKIP() << "PRELIGHT_MODELS is not set";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".glb" && entry.path().extension() != ".gltf") continue;
    Warnings warnings;
    const Scene scene = loadScene(readGltf(entry.path(), warnings), warnings);
    const CompiledScene compiled = compileScene(scene, warnings);
    const double before = processSeconds();
    const Made made = make(scene, compiled);
    std::cout << processSeconds() - before << " s  ";
    check(made, compiled, entry.path().filename().string());
  }
}

TEST(LightMapLayout, BoxFaces_AreRectanglesOfWholeTexels) {
  const CompiledScene scene = test::box(3, glm::vec3(0.0f), glm::vec3(2.0f, 1.0f, 0.7f), false);
  LightMapLayoutRequest request;
  request.texelSize = 0.1;
  const Made made = make(scene, request);
  ASSERT_EQ(made.layout.chartCount, 6u);
  const LayoutFigures figures = check(made, scene, "box");
  EXPECT_NEAR(figures.leastRatio, 1.0, 0.1);
  EXPECT_NEAR(figures.mostRatio, 1.0, 0.1);
  // 20 x 10, 20 x 7 and 10 x 7 texels, twice, each with one more row and column.
  EXPECT_EQ(made.layout.texels.size(), 2u * (21u * 11u + 21u * 8u + 11u * 8u));
}

TEST(LightMapLayout, TurnedQuad_KeepsItsSidesStraight) {
  CompiledScene scene = test::ground(4, 1.0f);
  for (glm::vec3& p : scene.positions) p = {0.8f * p.x + 0.6f * p.z, 0.0f, -0.6f * p.x + 0.8f * p.z};
  LightMapLayoutRequest request;
  request.texelSize = 0.1;
  const Made made = make(scene, request);
  EXPECT_EQ(made.layout.width * made.layout.height, 21 * 21);
  EXPECT_DOUBLE_EQ(check(made, scene, "turned quad").used, 1.0);
}

TEST(LightMapLayout, SmoothBall_IsCutIntoFewCharts) {
  const CompiledScene scene = test::sphere(32, 1.0f, glm::vec3(0.0f));
  const Made made = make(scene);
  EXPECT_LE(made.layout.chartCount, 16u);
  const LayoutFigures figures = check(made, scene, "ball");
  EXPECT_GE(figures.leastRatio, 0.45);
  EXPECT_LE(figures.mostRatio, 2.0);
  EXPECT_LT(figures.stretched, 0.01);
  EXPECT_EQ(facesWithChart(made.layout), scene.triangleCount());
}

TEST(LightMapLayout, CoincidentTriangles_GetPlacesOfTheirOwn) {
  std::vector<glm::uvec3> triangles;
  for (int i = 0; i < 5; ++i) triangles.push_back({0, 1, 2});
  const CompiledScene scene = test::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, triangles);
  const Made made = make(scene);
  check(made, scene, "five at one place");
  std::set<std::uint32_t> charts(made.layout.chartOf.begin(), made.layout.chartOf.begin() + 5);
  EXPECT_EQ(charts.size(), 5u);
}

/// A ramp that winds round an axis twice: flat everywhere, and above itself.
TEST(LightMapLayout, SpiralRamp_DoesNotCoverItself) {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  constexpr int steps = 128;
  for (int i = 0; i <= steps; ++i) {
    const float a = 4.0f * std::numbers::pi_v<float> * float(i) / steps;
    for (const float r : {1.0f, 2.0f})
      positions.emplace_back(r * std::cos(a), 0.01f * float(i), r * std::sin(a));
  }
  for (std::uint32_t i = 0; i < steps; ++i) {
    triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
    triangles.push_back({2 * i + 1, 2 * i + 2, 2 * i + 3});
  }
  const CompiledScene scene = test::sceneOf(positions, triangles);
  const Made made = make(scene);
  EXPECT_EQ(made.layout.chartCount, 2u);
  EXPECT_LT(check(made, scene, "spiral").stretched, 0.01);
}

CompiledScene moebiusStrip() {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  constexpr std::uint32_t steps = 96;
  for (std::uint32_t i = 0; i < steps; ++i) {
    const float a = 2.0f * std::numbers::pi_v<float> * float(i) / steps;
    for (const float w : {-0.3f, 0.3f}) {
      const float r = 1.0f + w * std::cos(a / 2.0f);
      positions.emplace_back(r * std::cos(a), w * std::sin(a / 2.0f), r * std::sin(a));
    }
  }
  for (std::uint32_t i = 0; i < steps; ++i) {
    const bool last = i + 1 == steps;  // Here the strip meets its other side.
    const std::uint32_t a = 2 * i, b = 2 * i + 1, c = last ? 1 : 2 * i + 2, d = last ? 0 : 2 * i + 3;
    triangles.push_back({a, c, b});
    triangles.push_back({b, c, d});
  }
  return test::sceneOf(positions, triangles);
}

TEST(LightMapLayout, MoebiusStrip_HasBothSides) {
  CompiledScene scene = moebiusStrip();
  scene.materials[0].doubleSided = true;
  const Made made = make(scene);
  EXPECT_LT(check(made, scene, "Moebius strip").stretched, 0.02);
  EXPECT_EQ(facesWithChart(made.layout), 2u * scene.triangleCount());
}

TEST(LightMapLayout, TinyTriangles_GetATexelEach) {
  // The triangles are apart from one another, each a ten-thousandth of the cube's size.
  const CompiledScene scene = test::randomSoup(100000, 1e-4f, 3);
  LightMapLayoutRequest request;
  request.texelSize = 0.01;
  const double before = processSeconds();
  const Made made = make(scene, request);
  EXPECT_LT(processSeconds() - before, 4.0);
  const LayoutFigures figures = check(made, scene, "soup");
  EXPECT_EQ(made.layout.texels.size(), scene.triangleCount());
  EXPECT_GE(figures.used, 0.9);
}

TEST(LightMapLayout, LargeBall_IsLaidOutInSeconds) {
  const CompiledScene scene = test::sphere(160, 1.0f, glm::vec3(0.0f));
  ASSERT_GE(scene.triangleCount(), 100000u);
  const double before = processSeconds();
  const Made made = make(scene);
  const double seconds = processSeconds() - before;
  std::cout << seconds << " s of processor time\n";
  EXPECT_LT(seconds, 4.0);
  EXPECT_GE(check(made, scene, "large ball").used, 0.6);
}

TEST(LightMapLayout, Slivers_AreHeld) {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const glm::vec3 a(uniform(random), uniform(random), uniform(random)),
        b(uniform(random), uniform(random), uniform(random));
    positions.insert(positions.end(), {a, b, 0.5f * (a + b) + glm::vec3(1e-6f, 0.0f, 0.0f)});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const CompiledScene scene = test::sceneOf(positions, triangles);
  check(make(scene), scene, "slivers");
}

TEST(LightMapLayout, FanAroundOneEdge_TakesNoTimeOfItsSquare) {
  std::vector<glm::vec3> positions = {{0, 0, 0}, {0, 1, 0}};
  std::vector<glm::uvec3> triangles;
  for (std::uint32_t i = 0; i < 50000; ++i) {
    const float a = 2.0f * std::numbers::pi_v<float> * float(i) / 50000.0f;
    positions.emplace_back(std::cos(a), 0.5f, std::sin(a));
    triangles.push_back(i % 2 == 0 ? glm::uvec3(0, 1, i + 2) : glm::uvec3(1, 0, i + 2));
  }
  const CompiledScene scene = test::sceneOf(positions, triangles);
  LightMapLayoutRequest request;
  request.texelSize = 0.5;
  const double before = processSeconds();
  const Made made = make(scene, request);
  EXPECT_LT(processSeconds() - before, 5.0);
  check(made, scene, "fan");
}

/// A white right triangle with sides of 1 and the given texture coordinates.
Made triangleWith(const std::vector<float>& coords, CompiledScene& compiled) {
  GltfDocument document = test::triangleDocument();
  document.json["materials"][0] = {{"pbrMetallicRoughness", {{"metallicFactor", 0.0}}}};
  document.json["meshes"][0]["primitives"][0]["material"] = 0;
  document.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] =
      test::appendFloats(document, coords, "VEC2");
  Warnings warnings;
  const Scene scene = loadScene(document, warnings);
  compiled = compileScene(scene, warnings);
  LightMapLayoutRequest request;
  request.texelSize = 0.05;
  return make(scene, compiled, request);
}

TEST(LightMapLayout, SecondTexCoords_AreKept) {
  CompiledScene compiled;
  const Made made = triangleWith({0.0f, 0.5f, 0.5f, 0.5f, 0.0f, 0.0f}, compiled);
  ASSERT_EQ(made.charts.charts.size(), 1u);
  EXPECT_TRUE(made.charts.charts[0].fromFile);
  EXPECT_NEAR(check(made, compiled, "kept").leastRatio, 1.0, 0.1);
}

TEST(LightMapLayout, TexCoordsThatAreNoChart_AreReplaced) {
  CompiledScene compiled;
  EXPECT_FALSE(triangleWith({0, 2, 2, 2, 0, 0}, compiled).charts.charts[0].fromFile);  // Outside of 0..1.
  const Made made = triangleWith({0, 0, 0, 0, 0, 0}, compiled);                        // Without area.
  EXPECT_FALSE(made.charts.charts[0].fromFile);
  check(made, compiled, "replaced");
}

TEST(LightMapLayout, SameScene_GivesTheSame) {
  const CompiledScene scene = test::sphere(24, 1.0f, glm::vec3(0.5f));
  const Made first = make(scene), second = make(scene);
  EXPECT_EQ(first.layout.corners, second.layout.corners);
  EXPECT_EQ(first.layout.chartOf, second.layout.chartOf);
}

TEST(LightMapLayout, TexelSizes_MayDifferByChart) {
  const CompiledScene scene = test::box(1, glm::vec3(0.0f), glm::vec3(1.0f), false);
  LightMapLayoutRequest request;
  request.texelSize = 0.1;
  const LightMapCharts charts = makeLightMapCharts(Scene{}, scene, request);
  std::vector<double> sizes(charts.charts.size(), 0.1);
  sizes[2] = 0.05;
  const LightMapLayout layout = layOutLightMap(scene, charts, sizes);
  checkLayout(scene, layout, 0.1, "box");
  EXPECT_EQ(layout.texels.size(), 5u * 11u * 11u + 21u * 21u);
}

TEST(LightMapLayout, NoTexelSize_GivesAboutAsManyTexelsAsAskedFor) {
  const CompiledScene scene = test::sphere(32, 3.0f, glm::vec3(0.0f));
  LightMapLayoutRequest request;
  request.texels = 20000;
  const LightMapLayout layout = makeLightMapLayout(Scene{}, scene, request);
  EXPECT_NEAR(double(layout.texels.size()), 20000.0, 3000.0);
}

TEST(LightMapLayout, TooSmallTexels_AreRefused) {
  const CompiledScene scene = test::ground(1, 100.0f);
  LightMapLayoutRequest request;
  request.texelSize = 1e-3;
  EXPECT_THROW(make(scene, request), UsageError);
}

TEST(LightMapLayout, NothingToLight_IsEmpty) {
  CompiledScene scene = test::ground(1, 1.0f, 0.0f);
  scene.materials[0].albedo = glm::vec3(0.0f);
  const Made made = make(scene);
  EXPECT_TRUE(made.layout.texels.empty());
  EXPECT_EQ(facesWithChart(made.layout), 0u);
}

}  // namespace
}  // namespace prelight

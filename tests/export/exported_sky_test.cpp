#include "export/exported_lights.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "export/made_up_bake.h"
#include "export/prefiltered_sky.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/load_sky.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;
using std::numbers::pi;

/// A sky whose radiance grows with x, y and z, one per colour, so that every axis and sign matters.
Environment slopedSky(int width) {
  Environment sky{width, width / 2, {}};
  for (int y = 0; y < sky.height; ++y)
    for (int x = 0; x < sky.width; ++x) {
      const glm::dvec3 d = Environment::direction((x + 0.5) / sky.width, (y + 0.5) / sky.height);
      sky.radiance.emplace_back(2.0 + d.x, 2.0 + 1.5 * d.y, 2.0 + 0.5 * d.z + 0.5 * d.x * d.z);
    }
  return sky;
}

GltfDocument withSky(const Environment& sky) {
  GltfDocument document = test::triangleDocument();
  addSky(document, sky);
  return document;
}

const Json& lightOf(const GltfDocument& document) {
  return document.json["extensions"]["EXT_lights_image_based"]["lights"][0];
}

TEST(ExportedSky, ReadAgain_IsTheSky) {
  const Environment sky = slopedSky(256);
  Warnings warnings;
  const auto again = loadSky(withSky(sky), warnings);
  ASSERT_TRUE(again.has_value());
  EXPECT_THAT(warnings, ::testing::IsEmpty());
  for (int y = 1; y < 16; ++y)
    for (int x = 0; x < 32; ++x) {
      const double u = (x + 0.5) / 32, v = y / 16.0;
      const auto at = [&](const Environment& map) {
        return map.radiance[static_cast<std::size_t>(v * map.height) * static_cast<std::size_t>(map.width) +
                            static_cast<std::size_t>(u * map.width)];
      };
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(at(*again)[c], at(sky)[c], 0.03) << u << " " << v << " " << c;
    }
}

/// Radiance a + b d.axis has irradiance E(n) = pi a + 2 pi / 3 b n.axis; radiance x z has pi / 4 x z.
TEST(ExportedSky, Coefficients_GiveTheIrradianceInClosedForm) {
  const GltfDocument document = withSky(slopedSky(256));
  const Json& light = lightOf(document);
  for (const glm::dvec3 n : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1),
                             glm::normalize(glm::dvec3(0.3, -0.5, 0.8))}) {
    const glm::dvec3 d(n.x, n.y, -n.z);
    const std::array<double, 9> y = {0.28209479,
                                     0.48860251 * d.y,
                                     0.48860251 * d.z,
                                     0.48860251 * d.x,
                                     1.09254843 * d.x * d.y,
                                     1.09254843 * d.y * d.z,
                                     0.31539157 * (3 * d.z * d.z - 1),
                                     1.09254843 * d.z * d.x,
                                     0.54627422 * (d.x * d.x - d.y * d.y)};
    glm::dvec3 irradiance(0.0);
    for (std::size_t i = 0; i < 9; ++i)
      for (int c = 0; c < 3; ++c)
        irradiance[c] += light["intensity"].get<double>() * y[i] *
                         light["irradianceCoefficients"][i][static_cast<std::size_t>(c)].get<double>();
    EXPECT_NEAR(irradiance.x, 2 * pi + 2 * pi / 3 * n.x, 1e-3);
    EXPECT_NEAR(irradiance.y, 2 * pi + pi * n.y, 1e-3);
    EXPECT_NEAR(irradiance.z, 2 * pi + pi / 3 * n.z + pi / 8 * n.x * n.z, 1e-3);
  }
}

TEST(ExportedSky, Levels_HalveDownToSixteenTexels) {
  const Json light = lightOf(withSky(slopedSky(128)));
  EXPECT_EQ(light["specularImageSize"], 32);
  ASSERT_EQ(light["specularImages"].size(), 2u);
  for (const Json& faces : light["specularImages"]) EXPECT_EQ(faces.size(), 6u);
  const PrefilteredSky sky = prefilterSky(slopedSky(128));
  EXPECT_EQ(sky.levels.back().faceSize, 16);
  EXPECT_EQ(sky.roughness(0), 0.0);
  EXPECT_EQ(sky.roughness(1), 1.0);
}

/// At roughness 1 microfacet normals are evenly distributed (GGX with alpha 1 is 1 / pi). The weights are
/// cosines, and the mean of a + b d.n under them is a + 2 / 3 b.
TEST(PrefilteredSky, FullRoughness_IsTheCosineMean) {
  const PrefilteredSky sky = prefilterSky(slopedSky(128));
  const CubeMap& last = sky.levels.back();
  for (std::uint32_t i = 0; i < last.radiance.size(); i += 7) {
    const glm::dvec3 n = cubeTexelDirection(i, last.faceSize);
    EXPECT_NEAR(last.radiance[i].x, 2.0 + 2.0 / 3.0 * n.x, 2e-3);
    EXPECT_NEAR(last.radiance[i].y, 2.0 + n.y, 2e-3);
  }
}

/// Compares with the integral over the angle to the axis, in a thousand steps.
TEST(PrefilteredSky, MiddleRoughness_IsTheLobesMean) {
  constexpr double roughness = 0.5;
  const double alphaSquared = std::pow(roughness, 4.0);
  double sum = 0.0, weights = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double cosine = (i + 0.5) / 1000, half = 0.5 * (1.0 + cosine);
    const double weight = cosine / std::pow((alphaSquared - 1.0) * half + 1.0, 2.0);
    sum += weight * cosine;
    weights += weight;
  }
  const PrefilteredSky sky = prefilterSky(slopedSky(256));
  ASSERT_EQ(sky.roughness(1), roughness);
  const CubeMap& level = sky.levels[1];
  for (std::uint32_t i = 0; i < level.radiance.size(); i += 5) {
    const glm::dvec3 n = cubeTexelDirection(i, level.faceSize);
    EXPECT_NEAR(level.radiance[i].x, 2.0 + sum / weights * n.x, 3e-3);
    EXPECT_NEAR(level.radiance[i].y, 2.0 + 1.5 * sum / weights * n.y, 3e-3);
  }
}

TEST(ExportedSky, WhatALightMapHolds_IsNotThereTwice) {
  const Environment sky = slopedSky(64);
  const test::Baked baked = test::bakedOf(makeBuiltinScene("shapes"));
  const auto exportedAs = [&](const ExportRequest& request) {
    const test::TemporaryFolder folder;
    exportBake({baked.document, baked.scene, baked.compiled, baked.bake, &sky, &*baked.bake.lightMap},
               folder / "out.glb", "out", request);
    Warnings warnings;
    return lightOf(readGltf(folder / "out.glb", warnings));
  };
  const Json removed = exportedAs({});
  for (const Json& coefficient : removed["irradianceCoefficients"])
    EXPECT_EQ(coefficient, Json({0.0, 0.0, 0.0}));
  const Json kept = exportedAs({ExportTarget::Gltf, ExportForm::LightMap, BakedLights::Keep});
  EXPECT_EQ(removed["extras"]["prelight"]["irradianceCoefficients"], kept["irradianceCoefficients"]);
  EXPECT_NE(kept["irradianceCoefficients"][0], Json({0.0, 0.0, 0.0}));
  const Json occluded = exportedAs({ExportTarget::Gltf, ExportForm::Occlusion, BakedLights::Remove});
  EXPECT_EQ(occluded["irradianceCoefficients"], kept["irradianceCoefficients"]);
  EXPECT_EQ(removed["specularImages"].size(), kept["specularImages"].size());
}

}  // namespace
}  // namespace prelight

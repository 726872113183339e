// Pictures of measured materials against those of the analytic models from which they were tabulated.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/merl_files.h"
#include "support/shot.h"

namespace prelight::test {
namespace {

/// A sky that is bright above, dim below, and brighter towards one side.
Environment slantedSky() {
  Environment sky;
  sky.width = 64;
  sky.height = 32;
  sky.radiance.resize(64 * 32);
  for (int y = 0; y < sky.height; ++y)
    for (int x = 0; x < sky.width; ++x) {
      const float up = 1.0f - float(y) / float(sky.height), side = float(x) / float(sky.width);
      sky.radiance[static_cast<std::size_t>(y * sky.width + x)] =
          glm::vec3(0.2f + 2.0f * up, 0.5f + side, 1.0f);
    }
  return sky;
}

/// A ball on a plate, both of the same material.
Picture pictureOf(const CompiledMaterial& material) {
  CompiledScene scene = sphere(24, 0.5f, {0, 0.5f, 0});
  append(scene, ground(1, 1.0f));
  Shot shot = shotOf(std::move(scene), cameraAt({0, 1.6, 3}, {0, 0.3, 0}, 0.7), 24, 256);
  for (CompiledMaterial& m : shot.scene.materials) m = material;
  shot.sky = slantedSky();
  shot.request.depth = 4;
  return shot.render().picture();
}

double relativeRms(const Picture& a, const Picture& b) {
  double difference = 0.0, mean = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      difference += std::pow(double(a.pixels[i][c]) - double(b.pixels[i][c]), 2.0);
      mean += double(b.pixels[i][c]);
    }
  const double count = 3.0 * double(a.pixels.size());
  return std::sqrt(difference / count) / (mean / count);
}

// The table holds the first bounce between microfacets; the metal is dark enough for later bounces to vanish.
TEST(MeasuredPicture, OfGgx_IsThatOfMetalOfTheSameRoughness) {
  const float reflectance = 0.04f, roughness = 0.4f;
  const auto table =
      std::make_shared<const MeasuredBrdf>(tabulated([&](const glm::dvec3& wo, const glm::dvec3& wi) {
        const double rise = std::pow(1.0 - glm::dot(wo, glm::normalize(wo + wi)), 5.0);
        return ggxBrdf(glm::dvec3(double(reflectance) + (1.0 - double(reflectance)) * rise),
                       double(roughness))(wo, wi);
      }));
  const double error =
      relativeRms(pictureOf(measuredMaterial(table)), pictureOf(metal(reflectance, roughness)));
  EXPECT_LT(error, 0.012);
}

TEST(MeasuredPicture, OfLambert_IsTheDiffuseOne) {
  const auto table = std::make_shared<const MeasuredBrdf>(
      tabulated([](const auto&, const auto&) { return glm::dvec3(0.5 / std::numbers::pi); }));
  CompiledMaterial plain = lambert(0.5f);
  plain.albedo = plain.baseColor = table->diffuse;
  const Picture a = pictureOf(measuredMaterial(table)), b = pictureOf(plain);
  for (std::size_t i = 0; i < a.pixels.size(); ++i) EXPECT_EQ(a.pixels[i], b.pixels[i]);
}

// All light that arrives leaves: the table reflects all of it, and would reflect more at grazing angles if it
// were not scaled.
TEST(MeasuredPicture, InAWhiteFurnace_IsNeverBrighterThanTheSky) {
  const auto table = std::make_shared<const MeasuredBrdf>(tabulated(
      [](const glm::dvec3& wo, const glm::dvec3& wi) { return glm::dvec3(0.5 / (wo.z * wi.z + 0.05)); }));
  Shot shot = shotOf(sphere(24, 1.0f, {0, 0, 0}), orthographicCamera({0, 0, 5}, {0, 0, 0}, 0.9), 16, 256);
  shot.scene.materials[0] = measuredMaterial(table);
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  for (const glm::vec3& pixel : shot.render().picture().pixels) EXPECT_LE(pixel.x, 1.02f);
}

}  // namespace
}  // namespace prelight::test

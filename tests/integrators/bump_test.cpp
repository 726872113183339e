#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/shot.h"

// Normal textures in renderers that follow light, against closed forms.
namespace prelight::test {
namespace {

constexpr double reflectance = 0.5;
constexpr double strength = 3.0;  // W/m2.

/// An image of one colour.
Image evenImage(std::uint8_t r, std::uint8_t g, std::uint8_t b) { return {"bump", 1, 1, {r, g, b, 255}}; }

glm::dvec3 texel(const Image& image) {
  return 2.0 * glm::dvec3(image.rgba[0], image.rgba[1], image.rgba[2]) / 255.0 - 1.0;
}

/// A square in the plane y = 0, seen from above. `u` and `v` scale its texture coordinates, which grow along
/// x and z.
Shot bumpedShot(const CompiledMaterial& material, const Image& image, double u, double v) {
  CompiledScene scene = ground(1, 1.0f);
  for (std::size_t i = 0; i < scene.positions.size(); ++i) {
    const glm::vec3& p = scene.positions[i];
    scene.texCoords[i] = {static_cast<float>(u) * p.x, static_cast<float>(v) * p.z};
  }
  Shot shot = shotOf(std::move(scene), orthographicCamera({0, 1, 0}, {0, 0, 0}, 0.5), 4, 16);
  shot.scene.materials[0] = material;
  shot.scene.materials[0].normalTexture.image = 0;
  shot.images = {image};
  return shot;
}

Light sunAlong(const glm::dvec3& direction) {
  Light light;
  light.type = LightType::Directional;
  light.intensity = glm::vec3(static_cast<float>(strength));
  light.direction = glm::normalize(direction);
  return light;
}

void expectLitBy(const Shot& shot, const glm::dvec3& normal) {
  const double expected =
      reflectance / std::numbers::pi * strength * std::max(-glm::dot(normal, shot.lights[0].direction), 0.0);
  for (const glm::vec3& pixel : shot.render().picture().pixels) EXPECT_NEAR(pixel.x, expected, 3e-4);
}

const Image slope = evenImage(200, 90, 230);

TEST(Bumps, Normal_LeansAlongUAndAgainstV) {
  const glm::dvec3 t = texel(slope);
  for (const auto& [u, v] :
       {std::pair(1.0, 1.0), std::pair(-1.0, 1.0), std::pair(1.0, -1.0), std::pair(-3.0, -2.0)}) {
    Shot shot = bumpedShot(lambert(static_cast<float>(reflectance)), slope, u, v);
    shot.lights = {sunAlong({-0.7, -1.0, 0.4})};
    expectLitBy(shot,
                glm::normalize(glm::dvec3(std::copysign(t.x, u * t.x), t.z, -std::copysign(t.y, v * t.y))));
  }
}

TEST(Bumps, FilesTangents_TakeTheirPlace) {
  const glm::dvec3 t = texel(slope);
  for (const float w : {1.0f, -1.0f}) {
    Shot shot = bumpedShot(lambert(static_cast<float>(reflectance)), slope, 1.0, 1.0);
    shot.scene.tangents.assign(4, glm::vec4(0.0f, 0.0f, 1.0f, w));
    shot.lights = {sunAlong({-0.7, -1.0, 0.4})};
    const glm::dvec3 bitangent = double(w) * glm::cross(glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1));
    expectLitBy(shot,
                glm::normalize(t.x * glm::dvec3(0, 0, 1) + t.y * bitangent + t.z * glm::dvec3(0, 1, 0)));
  }
}

TEST(Bumps, Scale_IsOfXAndY) {
  const glm::dvec3 t = texel(slope);
  Shot shot = bumpedShot(lambert(static_cast<float>(reflectance)), slope, 1.0, 1.0);
  shot.scene.materials[0].normalScale = 0.25f;
  shot.lights = {sunAlong({-0.7, -1.0, 0.4})};
  expectLitBy(shot, glm::normalize(glm::dvec3(0.25 * t.x, t.z, -0.25 * t.y)));
}

TEST(Bumps, Back_IsTheFrontsReverse) {
  const glm::dvec3 t = texel(slope);
  Shot shot = bumpedShot(lambert(static_cast<float>(reflectance)), slope, 1.0, 1.0);
  shot.scene.materials[0].doubleSided = true;
  shot.camera = orthographicCamera({0, -1, 0}, {0, 0, 0}, 0.5);
  shot.lights = {sunAlong({0.7, 1.0, 0.4})};
  expectLitBy(shot, -glm::normalize(glm::dvec3(t.x, t.z, -t.y)));
}

/// Diffuse light of a point does not change with the view, even from where a bump would be hidden.
TEST(Bumps, LambertSeenFromAnywhere_IsLitByTheTexturesNormal) {
  const Image steep = evenImage(255, 128, 148);
  const glm::dvec3 t = texel(steep);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(t.x, t.z, -t.y));
  Shot shot = bumpedShot(lambert(static_cast<float>(reflectance)), steep, 1.0, 1.0);
  shot.lights = {sunAlong({-0.7, -1.0, 0.4})};
  for (const glm::dvec3& eye : {glm::dvec3(0.0, 3.0, 0.0), glm::dvec3(-1.5, 0.3, 0.2),
                                glm::dvec3(1.5, 0.05, 0.0), glm::dvec3(-3.0, 0.05, 0.0)}) {
    shot.camera = cameraAt(eye, {0, 0, 0}, 0.002);
    expectLitBy(shot, normal);
  }
}

/// Diffuse light of a sky, found by paths, does not change with the view either.
TEST(Bumps, LambertSeenFromAnywhere_ReflectsAsMuchOfASky) {
  Shot shot = bumpedShot(lambert(1.0f), evenImage(255, 128, 148), 1.0, 1.0);
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  shot.request.samples = 4096;
  const glm::dvec3 t = glm::normalize(texel(evenImage(255, 128, 148)));
  for (const auto estimator :
       {reference::Estimator::Both, reference::Estimator::LightsOnly, reference::Estimator::ScatterOnly}) {
    shot.request.estimator = estimator;
    shot.camera = cameraAt({-3.0, 0.3, 0.2}, {0, 0, 0}, 0.02);
    const MeanAndError found = meanOf(shot.render());
    EXPECT_NEAR(found.mean, 0.5 * (1.0 + t.z), 5.0 * found.error + 1e-4);
  }
}

/// A mirror reflects all light under an even sky, however its bumps lean.
TEST(Bumps, SteepMirror_ShowsNoBlackUnderAnEvenSky) {
  for (const Image& image : {slope, evenImage(255, 128, 128), evenImage(20, 20, 140)}) {
    Shot shot = bumpedShot(metal(1.0f, 0.0f), image, 1.0, 1.0);
    shot.sky = constantEnvironment(glm::vec3(1.0f));
    for (const double height : {3.0, 0.4, 0.05}) {
      shot.camera = cameraAt({1.5, height, 0.5}, {0, 0, 0}, 0.1);
      for (const glm::vec3& pixel : shot.render().picture().pixels) EXPECT_NEAR(pixel.x, 1.0, 1e-5) << height;
    }
  }
}

/// Light from below the triangle never comes through a bump.
TEST(Bumps, LitFromBehind_StayBlack) {
  Shot shot = bumpedShot(lambert(static_cast<float>(reflectance)), evenImage(255, 128, 128), 1.0, 1.0);
  shot.lights = {sunAlong({-1.0, 0.1, 0.0})};
  for (const glm::vec3& pixel : shot.render().picture().pixels) EXPECT_EQ(pixel, glm::vec3(0.0f));
}

/// A diffuse surface reflects no more than arrives, wherever its bumps lean.
TEST(Bumps, LambertUnderAnEvenSky_LosesWhatLeansBelowTheTriangle) {
  const Image image = evenImage(218, 128, 218);  // 45 degrees.
  Shot shot = bumpedShot(lambert(1.0f), image, 1.0, 1.0);
  shot.sky = constantEnvironment(glm::vec3(1.0f));
  shot.request.samples = 4096;
  const glm::dvec3 t = glm::normalize(texel(image));
  // Share of the leaning hemisphere above the plane: (1 + cos) / 2.
  const MeanAndError found = meanOf(shot.render());
  EXPECT_NEAR(found.mean, 0.5 * (1.0 + t.z), 5.0 * found.error + 1e-4);
}

}  // namespace
}  // namespace prelight::test

#include "scene/gltf/load/load_sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "images/picture_codecs.h"
#include "scene/gltf/gltf_embed.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

/// Adds a picture for a face with the bytes 0, 51, 102, 153, 204 or 255. With `cornered`, its lower left
/// quarter is black.
int addFace(GltfDocument& document, int size, int face, bool cornered) {
  Image image{"", size, size, {}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const bool corner = cornered && 2 * x < size && 2 * y >= size;
      const auto value = static_cast<std::uint8_t>(corner ? 0 : 51 * face);
      image.rgba.insert(image.rgba.end(), {value, value, value, 255});
    }
  const int view = appendBufferView(document, encodePng(image));
  document.json["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
  return static_cast<int>(document.json["images"].size()) - 1;
}

GltfDocument withSky(bool cornered = false) {
  GltfDocument document = test::triangleDocument();
  Json faces = Json::array();
  for (int face = 0; face < 6; ++face) faces.push_back(addFace(document, 16, face, cornered));
  Json coefficients = Json::array();
  for (int i = 0; i < 9; ++i) coefficients.push_back({0, 0, 0});
  document.json["extensions"]["EXT_lights_image_based"]["lights"] =
      Json::array({{{"specularImages", Json::array({faces})},
                    {"specularImageSize", 16},
                    {"irradianceCoefficients", coefficients}}});
  document.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
  return document;
}

Json& lightOf(GltfDocument& document) {
  return document.json["extensions"]["EXT_lights_image_based"]["lights"][0];
}

glm::vec3 radianceAt(const Environment& sky, const glm::dvec3& direction) {
  const glm::dvec2 uv = Environment::coordinates(glm::normalize(direction));
  const int x = std::min(static_cast<int>(uv.x * sky.width), sky.width - 1);
  const int y = std::min(static_cast<int>(uv.y * sky.height), sky.height - 1);
  return sky.radiance[static_cast<std::size_t>(y) * static_cast<std::size_t>(sky.width) +
                      static_cast<std::size_t>(x)];
}

double linearOf(double value) { return std::pow(value, 2.2); }

Environment loadedSky(const GltfDocument& document) {
  Warnings warnings;
  const auto sky = loadSky(document, warnings);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  EXPECT_TRUE(sky.has_value());
  return *sky;
}

TEST(FileSky, FacesOfTheCube_LieWhereProgramsThatWriteThemPutThem) {
  const Environment sky = loadedSky(withSky());
  const auto expect = [&](const glm::dvec3& direction, int face) {
    const double expected = face == 0 ? 0.0 : linearOf(face / 5.0);
    EXPECT_NEAR(radianceAt(sky, direction).x, expected, 1e-6) << face;
  };
  expect({1, 0.1, 0.1}, 0);
  expect({-1, 0.1, 0.1}, 1);
  expect({0.1, 1, 0.1}, 2);
  expect({0.1, -1, 0.1}, 3);
  expect({0.1, 0.1, -1}, 4);
  expect({0.1, 0.1, 1}, 5);
}

/// An eye that looks along -Z sees that face upside down and not mirrored: -X is left, and the lower row of
/// the picture is up, +Y. The other faces are turned in the same way. Babylon.js 7.34 shows such a cube like
/// this in a right-handed scene.
TEST(FileSky, PicturesStandOnTheirHeads) {
  const Environment sky = loadedSky(withSky(true));
  EXPECT_EQ(radianceAt(sky, {-0.5, 0.5, -1}).x, 0.0f);
  EXPECT_GT(radianceAt(sky, {0.5, 0.5, -1}).x, 0.0f);
  EXPECT_GT(radianceAt(sky, {-0.5, -0.5, -1}).x, 0.0f);
  EXPECT_EQ(radianceAt(sky, {-1, 0.5, 0.5}).x, 0.0f) << "looking along -X, left is +Z";
  EXPECT_GT(radianceAt(sky, {-1, 0.5, -0.5}).x, 0.0f);
}

TEST(FileSky, IntensityAndRotation_AreApplied) {
  GltfDocument document = withSky();
  lightOf(document)["intensity"] = 3;
  const double half = std::sqrt(0.5);
  lightOf(document)["rotation"] = {0, half, 0, half};  // Counter-clockwise from above: -Z goes to -X.
  const Environment sky = loadedSky(document);
  EXPECT_NEAR(radianceAt(sky, {-1, 0.1, 0.1}).x, 3.0 * linearOf(0.8), 1e-5);
}

TEST(FileSky, WithoutAnExtensionOrOnAnotherScene_IsNone) {
  Warnings warnings;
  EXPECT_FALSE(loadSky(test::triangleDocument(), warnings).has_value());
  GltfDocument document = withSky();
  document.json["scenes"][0].erase("extensions");
  EXPECT_FALSE(loadSky(document, warnings).has_value());
}

/// Irradiance pi from everywhere is radiance 1. For light that grows with y, radiance is 3 / (2 pi) times
/// irradiance.
TEST(FileSky, BrokenPictures_LeaveTheCoefficientsWithAWarning) {
  GltfDocument document = withSky();
  document.json["images"][3].erase("bufferView");
  const double pi = std::numbers::pi;
  lightOf(document)["irradianceCoefficients"][0] = {pi / 0.282095, 0, 0};
  lightOf(document)["irradianceCoefficients"][1] = {0, 2.0 * pi / 3.0 / 0.488603, 0};
  Warnings warnings;
  const auto sky = loadSky(document, warnings);
  ASSERT_TRUE(sky.has_value());
  EXPECT_TRUE(test::anyContains(warnings, "irradiance coefficients"));
  EXPECT_NEAR(radianceAt(*sky, {0.3, 0.2, 0.9}).x, 1.0, 1e-5);
  EXPECT_NEAR(radianceAt(*sky, {0, 1, 0}).y, 1.0, 1e-3);
  EXPECT_EQ(radianceAt(*sky, {0, -1, 0}).y, 0.0f) << "radiance is not negative";
}

// The code that embeds pictures has already warned of a missing one.
TEST(FileSky, PictureThatIsNotThere_LeavesTheCoefficients) {
  GltfDocument document = withSky();
  document.json["images"][2] = {{"uri", "missing.png"}};
  lightOf(document)["irradianceCoefficients"][0] = {std::numbers::pi / 0.282095, 0, 0};
  Warnings warnings;
  const auto sky = loadSky(document, warnings);
  ASSERT_TRUE(sky.has_value());
  EXPECT_NEAR(radianceAt(*sky, {0.3, 0.2, 0.9}).x, 1.0, 1e-5);
  EXPECT_EQ(radianceAt(*sky, {0.3, 0.2, 0.9}).y, 0.0f);
}

TEST(FileSky, BrokenNumbers_AreRefusedWithTheirPlace) {
  const auto errorOf = [](const std::function<void(Json&)>& change) {
    GltfDocument document = withSky();
    change(lightOf(document));
    Warnings warnings;
    return test::inputErrorOf([&] { loadSky(document, warnings); });
  };
  const auto expect = [&](const std::function<void(Json&)>& change, const char* place) {
    EXPECT_NE(errorOf(change).find(place), std::string::npos) << errorOf(change);
  };
  expect([](Json& light) { light["specularImages"][0][5] = 99; }, "/lights/0/specularImages/0/5");
  expect([](Json& light) { light["specularImages"][0].erase(5); }, "/lights/0/specularImages/0");
  expect([](Json& light) { light["irradianceCoefficients"].erase(8); }, "/lights/0/irradianceCoefficients");
  expect([](Json& light) { light["intensity"] = -1; }, "/lights/0/intensity");
  expect([](Json& light) { light["rotation"] = {1}; }, "/lights/0/rotation");
}

}  // namespace
}  // namespace prelight

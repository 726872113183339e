// Shadow maps of lamps in shadings that do not show all light, and factors of the parts of a picture.
#include <gtest/gtest.h>

#include <numbers>

#include "prelight/error.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/options/part_option.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using test::QuadScene;
using test::square;
using viewer::LayerFactors;
using viewer::Shading;

constexpr int pixels = 9;
constexpr glm::dvec3 lamp(0.0, 0.0, 2.0), shade(0.1, 0.2, 0.5);

/// A white floor under a lamp, and a square between them.
QuadScene floorUnderAShade() {
  QuadScene quads;
  Material sheet = test::lambertian(glm::vec3(0.5f));
  sheet.doubleSided = true;
  quads.add(test::lambertian(glm::vec3(1.0f)), 2.0f);
  glm::dmat4 place(1.0);
  place[3] = glm::dvec4(shade, 1.0);
  quads.add(sheet, 0.3f, place);
  quads.scene.lights = {test::makeLight(LightType::Point, glm::vec3(5.0f), lamp)};
  quads.compile();
  quads.bakeOpen(3, 1, 1.0f);
  quads.bake.bentNormals.assign(quads.compiled.vertexCount(), glm::vec3(0, 0, 1));
  return quads;
}

/// The radiance of a place on the floor, seen from below the square.
float radianceAt(QuadScene& quads, const glm::dvec3& place, Shading shading, LampShadows direct) {
  quads.scene.cameras.clear();
  quads.lookFrom(place + glm::dvec3(0.01, 0.0, 0.2), place);
  viewer::RenderOptions options = square(shading, pixels);
  options.direct = direct;
  Warnings notes;
  return viewer::renderPicture(quads.inputs(), options, notes).pixels[pixels * pixels / 2].g;
}

/// That of an open floor.
float openRadianceAt(const glm::dvec3& place) {
  const glm::dvec3 path = lamp - place;
  const double distance = glm::length(path);
  return static_cast<float>(5.0 * path.z / (distance * distance * distance) / std::numbers::pi);
}

class LampShadowsOf : public testing::TestWithParam<Shading> {};

TEST_P(LampShadowsOf, SquareBeforeALamp_DarkensWhatLiesBehindIt) {
  QuadScene quads = floorUnderAShade();
  const glm::dvec3 behind = lamp + (shade - lamp) * (lamp.z / (lamp.z - shade.z)), beside(-0.7, -0.6, 0.0);
  const LampShadows direct = GetParam() == Shading::Sh ? LampShadows::Maps : LampShadows::Auto;
  EXPECT_NEAR(radianceAt(quads, behind, GetParam(), direct), 0.0f, 1e-6f);
  EXPECT_NEAR(radianceAt(quads, beside, GetParam(), direct), openRadianceAt(beside), 2e-3f);
  EXPECT_NEAR(radianceAt(quads, behind, Shading::Phong, LampShadows::Baked), openRadianceAt(behind), 2e-3f);
}

INSTANTIATE_TEST_SUITE_P(Shadings, LampShadowsOf, testing::Values(Shading::Phong, Shading::Ao, Shading::Sh),
                         [](const auto& info) { return std::string(shadingName(info.param)); });

TEST(LampShadows, LargeLamp_HasSoftShadows) {
  QuadScene quads = floorUnderAShade();
  quads.scene.lights.front().radius = 0.3f;
  // Behind the edge of the square, as the lamp's middle sees it.
  const glm::dvec3 edge = shade - glm::dvec3(0.3, 0.0, 0.0);
  const glm::dvec3 behind = lamp + (edge - lamp) * (lamp.z / (lamp.z - edge.z));
  const float share = radianceAt(quads, behind, Shading::Phong, LampShadows::Auto) / openRadianceAt(behind);
  EXPECT_GT(share, 0.2f);
  EXPECT_LT(share, 0.8f);
}

Picture drawn(const QuadScene& quads, const LayerFactors& factors) {
  viewer::RenderOptions options = square(Shading::Phong, 32);
  options.layers = factors;
  Warnings notes;
  return viewer::renderPicture(quads.inputs(), options, notes);
}

LayerFactors factorsOf(std::initializer_list<const char*> texts) {
  LayerFactors factors = viewer::wholePicture;
  for (const char* text : texts) viewer::setPartFactor(text, factors);
  return factors;
}

TEST(PartFactors, PartsOfAPicture_SumUpToIt) {
  QuadScene quads = floorUnderAShade();
  quads.setSky(test::halvedSky());
  quads.lookFrom({0.2, -2.5, 2.0}, {0, 0, 0});
  const Picture whole = drawn(quads, viewer::wholePicture);
  const Picture without = drawn(quads, factorsOf({"direct=0"}));
  const Picture alone = drawn(quads, factorsOf({"all=0", "direct=1"}));
  const Picture tripled = drawn(quads, factorsOf({"direct=3"}));
  bool anyDirect = false;
  for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
    const glm::vec3 sum = without.pixels[i] + alone.pixels[i];
    EXPECT_LT(glm::length(sum - whole.pixels[i]), 1e-5f * (1.0f + glm::length(sum)));
    EXPECT_LT(glm::length(without.pixels[i] + 3.0f * alone.pixels[i] - tripled.pixels[i]),
              1e-5f * (1.0f + glm::length(tripled.pixels[i])));
    anyDirect = anyDirect || alone.pixels[i].g > 0.01f;
  }
  EXPECT_TRUE(anyDirect);
}

TEST(PartOption, Texts_SetFactorsOfTheirParts) {
  const LayerFactors factors = factorsOf({"all=0", "caustic=1.5", "reflected=2"});
  EXPECT_EQ(factors, (LayerFactors{0.0f, 0.0f, 0.0f, 1.5f, 2.0f, 0.0f, 0.0f}));
}

TEST(PartOption, WrongTexts_AreErrorsThatNameTheParts) {
  for (const char* text : {"direct", "=1", "direct=", "direct=x", "direct=-1", "direct=1e9", "direct=nan"}) {
    LayerFactors factors = viewer::wholePicture;
    EXPECT_THROW(viewer::setPartFactor(text, factors), UsageError) << text;
  }
  LayerFactors factors = viewer::wholePicture;
  try {
    viewer::setPartFactor("caustics=1", factors);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("caustic"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("emitted"), std::string::npos) << error.what();
  }
}

TEST(CarriedShading, OfABakeOfManyKinds_IsTheOneThatShowsTheLight) {
  Bake bake;
  bake.sh.emplace();
  bake.lightMap.emplace();
  bake.ao = {1.0f};
  bake.bentNormals = {glm::vec3(0, 0, 1)};
  const viewer::LightOfPicture room{.sky = false, .inside = true};
  EXPECT_EQ(viewer::carriedShading(bake, room).shading, Shading::LightMap);
  EXPECT_EQ(viewer::carriedShading(bake, {.sky = false, .inside = true, .asBaked = false}).shading,
            Shading::Sh);
  EXPECT_EQ(viewer::carriedShading(bake, {.sky = true, .asBaked = false}).shading, Shading::Sh);
  bake.lightMap.reset();
  bake.lightGroups.emplace();
  EXPECT_EQ(viewer::carriedShading(bake, room).shading, Shading::Lights);
  EXPECT_EQ(viewer::carriedShading(bake, {.sky = true, .inside = true}).shading, Shading::Sh);
  EXPECT_EQ(viewer::carriedShading(Bake{}, room).shading, Shading::Phong);
}

TEST(CarriedShading, WhereSurfacesEncloseOneAnother_ShowsBounces) {
  Bake bake;
  bake.sh.emplace();
  bake.info.bounces = 2;
  bake.bentNormals = {glm::vec3(0, 0, 1)};
  const viewer::LightOfPicture sun{.sky = false, .outside = true};
  bake.ao = {0.9f, 0.7f};  // an open place, where the sun's shadows count
  EXPECT_EQ(viewer::carriedShading(bake, sun).shading, Shading::Ao);
  EXPECT_LT(viewer::carriedShading(bake, sun).error, 0.05f);
  bake.ao = {0.3f, 0.1f};  // a room
  EXPECT_EQ(viewer::carriedShading(bake, sun).shading, Shading::Sh);
  EXPECT_LT(viewer::carriedShading(bake, sun).error, 0.1f);
}

/// Transfer holds the bounces of light from afar alone.
TEST(CarriedShading, ByLampsInARoomAlone_IsExpectedToErrFromTransfer_ButNotFromItsOwnLight) {
  const viewer::LightOfPicture lamps{.sky = false, .inside = true};
  Bake bake;
  bake.sh.emplace();
  bake.info.bounces = 2;
  EXPECT_GT(viewer::carriedShading(bake, lamps).error, 0.1f);
  EXPECT_LT(viewer::carriedShading(bake, {.sky = true, .inside = true}).error, 0.1f);
  bake.bentNormals = {glm::vec3(0, 0, 1)};
  bake.ao = {0.3f, 0.1f};  // a room
  EXPECT_GT(viewer::carriedShading(bake, lamps).error, 0.1f);
  bake.ao = {0.9f, 0.7f};  // an open place
  EXPECT_LT(viewer::carriedShading(bake, lamps).error, 0.1f);
  bake.ao = {0.3f, 0.1f};
  bake.lightGroups.emplace();
  EXPECT_EQ(viewer::carriedShading(bake, lamps).shading, Shading::Lights);
  EXPECT_LT(viewer::carriedShading(bake, lamps).error, 0.1f);
  bake.lightGroups.reset();
  bake.lightMap.emplace();
  EXPECT_LT(viewer::carriedShading(bake, lamps).error, 0.1f);
  EXPECT_GT(viewer::carriedShading(Bake{}, lamps).error, 0.1f);
}

}  // namespace
}  // namespace prelight

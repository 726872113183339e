// Screen-space occlusion compared with closed forms and with traced accessibility.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "benchmarks/truth/traced_accessibility.h"
#include "options/sound_rows.h"
#include "prelight/load.h"
#include "support/devices.h"
#include "viewer/corner_scene.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/options/shading_options.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"
#include "viewer/techniques/screen/occlusion_band.h"

namespace prelight {
namespace {

using namespace test;
using viewer::OcclusionMethod;
using viewer::ScreenOcclusionOptions;
using viewer::Shading;

using std::numbers::pi;

constexpr std::array<OcclusionMethod, 3> methods = {OcclusionMethod::Ssao, OcclusionMethod::Hbao,
                                                    OcclusionMethod::Gtao};
constexpr std::array<OcclusionMethod, 6> allMethods = {OcclusionMethod::Ssao, OcclusionMethod::Hbao,
                                                       OcclusionMethod::Gtao, OcclusionMethod::Disks,
                                                       OcclusionMethod::Ssdo, OcclusionMethod::Fields};

void expectCorner(const QuadScene& corner, int size, double scale, double tolerance,
                  OcclusionMethod method = OcclusionMethod::Gtao) {
  const double radius = 0.5 * scale;
  ScreenOcclusionOptions options = within(radius, method);
  options.cells = 1 << 15;
  options.fieldRays = 256;
  const Picture picture = corner.render(screenOptions(size, options));
  for (const double distance : {0.05, 0.1, 0.2, 0.3, 0.4, 0.6})
    for (const double y : {-0.3, 0.0, 0.2}) {
      const glm::dvec3 point = scale * glm::dvec3(-distance, y, 0.0);
      EXPECT_NEAR(pixelOf(picture, corner, point).r, openBeforeWall(scale * distance, radius), tolerance)
          << distance << " " << y;
    }
}

/// Least and greatest value in a picture of a wide floor, with a radius of 1 m.
std::pair<float, float> rangeOfPlane(OcclusionMethod method, const glm::dvec3& eye) {
  QuadScene plane;
  plane.add(lambertian(glm::vec3(1)), 30.0f);
  plane.setSky(constantEnvironment(glm::vec3(1)));
  plane.lookFrom(eye, {0, 0, 0});
  plane.compile();
  std::pair<float, float> range(2.0f, 0.0f);
  for (const glm::vec3& pixel : plane.render(screenOptions(48, within(1.0, method))).pixels)
    range = {std::min(range.first, pixel.r), std::max(range.second, pixel.r)};
  return range;
}

TEST(ScreenOcclusion, Plane_IsOpen) {
  for (const OcclusionMethod method : allMethods) {
    const auto [least, most] = rangeOfPlane(method, {0.4, -1.4, 1.6});
    EXPECT_NEAR(least, 1.0f, 1e-4f) << static_cast<int>(method);
    EXPECT_NEAR(most, 1.0f, 1e-4f) << static_cast<int>(method);
    EXPECT_NEAR(rangeOfPlane(method, {0.4, -2.0, 0.3}).first, 1.0f, 0.05f) << "up to the horizon";
  }
}

TEST(ScreenOcclusion, Gtao_CornerOfTwoPlanes_IsTheClosedForm) { expectCorner(cornerScene(), 160, 1.0, 0.03); }

TEST(ScreenOcclusion, Disks_CornerOfTwoPlanes_IsTheClosedForm) {
  expectCorner(smallCorner(), 160, 1.0, 0.03, OcclusionMethod::Disks);
}

TEST(ScreenOcclusion, Fields_CornerOfTwoPlanes_IsTheClosedForm) {
  expectCorner(cornerScene(lambertian(glm::vec3(1)), 1.0, 1.0), 160, 1.0, 0.05, OcclusionMethod::Fields);
}

TEST(ScreenOcclusion, OrthographicCamera_ShowsTheClosedForm) {
  QuadScene corner = smallCorner();
  Camera& camera = corner.scene.cameras.front();
  camera.perspective = false;
  camera.xMag = camera.yMag = 1.2;
  for (const OcclusionMethod method : {OcclusionMethod::Gtao, OcclusionMethod::Disks})
    expectCorner(corner, 160, 1.0, 0.03, method);
}

TEST(ScreenOcclusion, Radius_IsInMetresAtEverySizeOfPicture) {
  for (const int size : {80, 240}) expectCorner(cornerScene(), size, 1.0, 0.05);
  expectCorner(cornerScene(lambertian(glm::vec3(1)), 100.0), 160, 100.0, 0.03);
}

TEST(ScreenOcclusion, OneLayer_CornerIsTheClosedForm) {
  ScreenOcclusionOptions options = within(0.5);
  options.layers = 1;
  const QuadScene corner = cornerScene();
  const Picture picture = corner.render(screenOptions(160, options));
  for (const double distance : {0.05, 0.2, 0.6})
    EXPECT_NEAR(pixelOf(picture, corner, {-distance, 0, 0}).r, openBeforeWall(distance, 0.5), 0.1)
        << distance;
}

TEST(ScreenOcclusion, SsaoAndHbao_DarkenTheCornerAndNothingFar) {
  const QuadScene corner = cornerScene();
  for (const OcclusionMethod method : {OcclusionMethod::Ssao, OcclusionMethod::Hbao}) {
    const Picture picture = corner.render(screenOptions(120, within(0.5, method)));
    const float close = pixelOf(picture, corner, {-0.05, 0, 0}).r;
    EXPECT_GT(close, 0.4f);
    EXPECT_LT(close, 0.75f);
    EXPECT_LT(close, pixelOf(picture, corner, {-0.3, 0, 0}).r);
    EXPECT_NEAR(pixelOf(picture, corner, {-0.7, 0, 0}).r, 1.0f, 0.02f);
  }
}

TEST(ScreenOcclusion, HolesOfAnAlphaMask_DoNotOcclude) {
  Material holes = lambertian(glm::vec3(1));
  holes.alphaMode = AlphaMode::Mask;
  holes.baseColor.a = 0.2f;
  const QuadScene corner = cornerScene(holes);
  for (const OcclusionMethod method : methods) {
    const Picture picture = corner.render(screenOptions(64, within(0.5, method)));
    EXPECT_NEAR(pixelOf(picture, corner, {-0.1, 0, 0}).r, 1.0f, 1e-3f);
  }
}

TEST(ScreenOcclusion, BlendedSurface_NeitherOccludesNorIsOccluded) {
  Material pane = lambertian(glm::vec3(1));
  pane.alphaMode = AlphaMode::Blend;
  const QuadScene corner = cornerScene(pane);
  const Picture picture = corner.render(screenOptions(64, within(0.5)));
  EXPECT_NEAR(pixelOf(picture, corner, {-0.1, 0, 0}).r, 1.0f, 1e-3f);
  EXPECT_NEAR(pixelOf(picture, corner, {0, 0, 0.1}).r, 1.0f, 1e-3f);
}

double meanOf(const Picture& picture) {
  double sum = 0.0;
  for (const glm::vec3& pixel : picture.pixels) sum += pixel.r;
  return sum / static_cast<double>(picture.pixels.size());
}

TEST(ScreenOcclusion, Thickness_OfWhatHasNoBack_DarkensWhatLiesBesideIt) {
  const QuadScene card = cardOverFloor();
  ScreenOcclusionOptions options = within(0.5);
  const double thin = meanOf(card.render(screenOptions(64, options)));
  options.thickness = 0.3;
  EXPECT_LT(meanOf(card.render(screenOptions(64, options))), thin - 1e-3);
}

TEST(ScreenOcclusion, BentNormal_TurnsToTheOpenSideOfTheSky) {
  QuadScene corner = smallCorner();
  corner.setSky(halvedSky());  // +X is red, -X green; the wall is at +X.
  for (const OcclusionMethod method : {OcclusionMethod::Gtao, OcclusionMethod::Disks}) {
    const Picture picture = corner.render(screenOptions(96, within(0.5, method)));
    const glm::vec3 beside = pixelOf(picture, corner, {-0.05, 0, 0}),
                    away = pixelOf(picture, corner, {-1.0, 0, 0});
    EXPECT_NEAR(away.r / away.g, 1.0f, 0.1f);
    EXPECT_LT(beside.r, 0.6f * beside.g);
  }
}

TEST(ScreenOcclusion, Interreflection_BrightensTheCornerByItsAlbedo) {
  QuadScene corner = cornerScene();
  for (Material& material : corner.scene.materials) material.baseColor = {0.5f, 0.5f, 0.5f, 1.0f};
  corner.compile();
  viewer::RenderOptions options = screenOptions(96, within(0.5));
  const double dark = pixelOf(corner.render(options), corner, {-0.1, 0, 0}).r / 0.5;
  options.aoCorrection = viewer::AoCorrection::Interreflection;
  EXPECT_NEAR(pixelOf(corner.render(options), corner, {-0.1, 0, 0}).r,
              0.5 * dark / (1.0 - 0.5 * (1.0 - dark)), 1e-3);
}

TEST(ScreenOcclusion, EmptyAndGrazingViews_AreFiniteAndWithinBounds) {
  QuadScene corner = cornerScene();
  const std::vector<std::pair<glm::dvec3, glm::dvec3>> views = {
      {{-1, 0, 1e-4}, {-0.5, 0, 0}},    // Along the floor.
      {{-1e-4, -1, 0.5}, {0, 0, 0.4}},  // Along the wall.
      {{-1, 0, 1}, {-2, 0, 3}},         // At the sky.
      {{-1e-3, 0, 1e-3}, {-0.5, 0.2, 0}}};
  for (const auto& [eye, target] : views) {
    corner.scene.cameras.clear();
    corner.lookFrom(eye, target);
    for (const OcclusionMethod method : allMethods) {
      const Picture picture = corner.render(screenOptions(33, within(0.7, method)));
      for (const glm::vec3& pixel : picture.pixels) {
        ASSERT_TRUE(pixel.r >= 0.0f && pixel.r <= 1.0001f) << pixel.r;
      }
    }
  }
}

TEST(ScreenOcclusion, Background_IsTheSky) {
  QuadScene corner = cornerScene();
  corner.setSky(constantEnvironment(glm::vec3(3)));
  corner.scene.cameras.clear();
  corner.lookFrom({-1, 0, 1}, {-2, 0, 3});
  const Picture picture = corner.render(screenOptions(16, within(0.5)));
  for (const glm::vec3& pixel : picture.pixels) EXPECT_EQ(pixel, glm::vec3(3));
}

/// Largest difference between a picture of twice `part` pixels per side and its quarters, each drawn on its
/// own.
double largestTileDifference(const ScreenOcclusionOptions& occlusion, int part) {
  const QuadScene corner = cornerScene();
  const viewer::gl::EglContext context;
  const viewer::RenderInputs inputs = corner.inputs();
  viewer::Renderer renderer(inputs);
  const int size = 2 * part;
  const viewer::View view = viewer::makeView(inputs, screenOptions(size, occlusion));
  const viewer::gl::Framebuffer whole(size, size), tile(part, part);
  renderer.draw(view, {0, 0, size, size}, whole);
  const std::vector<glm::vec4> all = whole.read();
  double worst = 0.0;
  for (const int x : {0, part})
    for (const int y : {0, part}) {
      renderer.draw(view, {x, y, part, part}, tile);
      const std::vector<glm::vec4> some = tile.read();
      for (int row = 0; row < part; ++row)  // From the bottom.
        for (int column = 0; column < part; ++column) {
          const int below = (size - y - part + row) * size + x + column;
          worst = std::max(worst, std::abs(double{some[row * part + column].r} - all[below].r));
        }
    }
  return worst;
}

TEST(ScreenOcclusion, Tiles_ShowWhatTheWholePictureShows) {
  for (const OcclusionMethod method : allMethods)
    EXPECT_LT(largestTileDifference(within(0.5, method), 30), 0.05) << static_cast<int>(method);
}

TEST(ScreenOcclusion, EveryNthPixel_IsThatOfTheWholePictureInTilesToo) {
  for (const int stride : {2, 3}) {
    ScreenOcclusionOptions options = within(0.5);
    options.stride = stride;
    EXPECT_LT(largestTileDifference(options, 31), 0.05) << stride;
  }
}

TEST(ScreenOcclusion, EverySecondPixel_CornerIsTheClosedForm) {
  ScreenOcclusionOptions options = within(0.5);
  options.stride = 2;
  const QuadScene corner = cornerScene();
  const Picture picture = corner.render(screenOptions(160, options));
  for (const double distance : {0.1, 0.2, 0.3, 0.4, 0.6})
    EXPECT_NEAR(pixelOf(picture, corner, {-distance, 0, 0}).r, openBeforeWall(distance, 0.5), 0.04)
        << distance;
}

TEST(ScreenOcclusion, MoreSamplesAPixel_ShowTheSamePicture) {
  const QuadScene corner = cornerScene();
  viewer::RenderOptions options = screenOptions(64, within(0.5));
  const Picture one = corner.render(options);
  options.samplesPerAxis = 3;
  const Picture nine = corner.render(options);
  double sum = 0.0;
  for (std::size_t i = 0; i < one.pixels.size(); ++i)
    sum += std::pow(one.pixels[i].r - nine.pixels[i].r, 2.0);
  EXPECT_LT(std::sqrt(sum / static_cast<double>(one.pixels.size())), 0.03);
}

/// Rms error of the accessibility of a built-in scene, with the default radius.
double errorOf(const std::string& name, const ScreenOcclusionOptions& occlusion) {
  const Scene scene = benchmarks::whitened(loadBuiltin(name).scene);
  Warnings warnings;
  const CompiledScene compiled = compileScene(scene, warnings);
  const Environment sky = constantEnvironment(glm::vec3(1));
  const viewer::RenderInputs inputs{scene, compiled, nullptr, &sky, &sharedDevice()};
  viewer::RenderOptions options = screenOptions(90, occlusion);
  options.width = 160;
  const viewer::View view = viewer::makeView(inputs, options);
  const Picture picture = viewer::renderPicture(inputs, options, warnings);
  std::vector<float> drawn;
  for (const glm::vec3& pixel : picture.pixels) drawn.push_back(pixel.r);
  Tracer tracer(compiled, sharedDevice());
  const double radius = viewer::occlusionRadius(occlusion, compiled);
  return benchmarks::accessibilityError(
      drawn,
      benchmarks::tracedAccessibility(compiled, tracer, {view.camera, view.width, view.height, radius, 128}));
}

TEST(ScreenOcclusion, Gtao_IsNearTracedAccessibility) {
  for (const char* name : {"shapes", "rooms", "cornell"}) EXPECT_LT(errorOf(name, {}), 0.08) << name;
}

TEST(ScreenOcclusion, Disks_AreNearTracedAccessibility) {
  ScreenOcclusionOptions options;
  options.method = OcclusionMethod::Disks;
  for (const char* name : {"shapes", "rooms", "cornell"}) {
    const double error = errorOf(name, options);
    EXPECT_LT(error, name == std::string("cornell") ? 0.08 : 0.6 * errorOf(name, {})) << name;
  }
}

TEST(ScreenOcclusion, Fields_AreNearTracedAccessibility) {
  ScreenOcclusionOptions options;
  options.method = OcclusionMethod::Fields;
  options.fieldRays = 64;
  for (const auto& [name, bound] : {std::pair("shapes", 0.035), {"rooms", 0.055}, {"cornell", 0.05}})
    EXPECT_LT(errorOf(name, options), bound) << name;
}

TEST(ScreenOcclusion, GtaoOfOneLayer_IsNearTracedAccessibility) {
  ScreenOcclusionOptions options;
  options.layers = 1;
  for (const char* name : {"shapes", "rooms", "cornell"}) EXPECT_LT(errorOf(name, options), 0.1) << name;
}

TEST(ScreenOcclusion, SsaoAndHbao_AreFartherFromTracedAccessibility) {
  const double gtao = errorOf("shapes", {});
  for (const auto& [method, bound] :
       {std::pair(OcclusionMethod::Hbao, 0.12), std::pair(OcclusionMethod::Ssao, 0.14)}) {
    ScreenOcclusionOptions options;
    options.method = method;
    const double error = errorOf("shapes", options);
    EXPECT_LT(error, bound);
    EXPECT_GT(error, gtao);
  }
}

/// Checks the reference itself, where the closed form is known.
TEST(TracedAccessibility, CornerOfTwoPlanes_IsTheClosedForm) {
  const QuadScene corner = cornerScene();
  Tracer tracer(corner.compiled, sharedDevice());
  const int size = 96;
  const std::vector<float> traced = benchmarks::tracedAccessibility(
      corner.compiled, tracer, {corner.scene.cameras.front(), size, size, 0.5, 1024});
  Picture picture{size, size, {}};
  for (const float value : traced) picture.pixels.emplace_back(value);
  for (const double distance : {0.1, 0.2, 0.3, 0.6})
    EXPECT_NEAR(pixelOf(picture, corner, {-distance, 0, 0}).r, openBeforeWall(distance, 0.5), 0.03)
        << distance;
}

TEST(ShadingOptions, Rows_AreSoundAndNameShadings) {
  std::set<std::string> fields, names;
  for (const auto& row : optionsOf<viewer::ShadingOptions>()) {
    test::expectSound(row, fields, names);
    EXPECT_FALSE(row.shadingNames().empty()) << row.name;
    for (const std::string_view name : row.shadingNames()) EXPECT_NO_THROW(viewer::parseShading(name));
  }
  for (const auto& row : optionsOf<viewer::RenderOptions>()) test::expectSound(row, fields, names);
}

TEST(ShadingOptions, NumbersBeyondTheirRanges_AreCutAndNaNBecomesTheDefault) {
  viewer::ShadingOptions options;
  options.screenOcclusion.radius = std::nan("");
  options.screenOcclusion.slices = 1000;
  options.screenOcclusion.layers = 0;
  const ScreenOcclusionOptions cut = viewer::withinRanges(options).screenOcclusion;
  EXPECT_EQ(cut.radius, ScreenOcclusionOptions{}.radius);
  EXPECT_EQ(cut.slices, 64);
  EXPECT_EQ(cut.layers, 1);
}

}  // namespace
}  // namespace prelight

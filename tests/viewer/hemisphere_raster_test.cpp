#include "viewer/hemisphere/hemisphere_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "basis/sh_evaluate.h"
#include "basis/sh_zonal.h"
#include "prelight/error.h"
#include "support/scenes.h"
#include "viewer/gl/egl_context.h"

namespace prelight::viewer {
namespace {

using std::numbers::pi;

class HemisphereMaps : public ::testing::TestWithParam<HemisphereMap> {
 protected:
  bool coversAll() const { return GetParam() != HemisphereMap::HemiPlane; }
};

/// Cosine-weighted share of the hemisphere that a square plate of half width `a` covers at height 1.
double plateShare(double a) {
  const double b = a / std::sqrt(1.0 + a * a);
  return 4.0 / pi * b * std::atan(b);
}

/// Transfer of order 4 of an open sky through a hemi-plane, if the unseen rest is as bright as the mean.
std::vector<double> meanTransfer(const glm::dvec3& normal) {
  std::vector<double> open(16, 0.0);
  const glm::dvec3 across = glm::normalize(glm::cross(normal, glm::dvec3(0, 0, 1)));
  // The plane's rotation about the normal does not affect bands below the fourth.
  const glm::dvec3 along = glm::cross(normal, across);
  std::vector<double> values(16);
  constexpr int cells = 400;
  constexpr double step = 4.5 / cells;
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      const glm::dvec2 p = glm::dvec2(x + 0.5, y + 0.5) * step - 2.25;
      const double r2 = 1.0 + glm::dot(p, p);
      sh::evaluate((normal + p.x * across + p.y * along) / std::sqrt(r2), 4, values);
      for (std::size_t c = 0; c < 16; ++c)
        open[c] += values[c] * step * step / (pi * r2 * r2) / plateShare(2.25);
    }
  return open;
}

/// A plate of half width `a` at height 1. An object far below it extends the scene's bounds.
CompiledScene plateAbove(float a) {
  CompiledScene scene = test::ground(8, a, 1.0f);
  test::append(scene, test::ground(1, 4.0f, -4.0f));
  scene.boundsMin = {-4, -4, -4};
  scene.boundsMax = {4, 1, 4};
  return scene;
}

CompiledScene room() {
  CompiledScene scene = test::box(4, {-2, -1, -2}, {2, 1, 2}, true);
  scene.boundsMin = {-2, -1, -2};
  scene.boundsMax = {2, 1, 2};
  return scene;
}

double openShare(const std::vector<double>& transfer) { return transfer[0] * std::sqrt(4.0 * pi); }

TEST_P(HemisphereMaps, Texels_CoverTheHemisphereOnce) {
  double angle = 0.0;
  const std::vector<HemisphereTexel> texels = texelsOf(GetParam(), 128);
  for (const HemisphereTexel& texel : texels) {
    angle += texel.solidAngle;
    EXPECT_NEAR(glm::length(texel.direction), 1.0, 1e-12);
  }
  if (!coversAll()) {
    EXPECT_NEAR(coverageOf(texels), plateShare(2.25), 1e-4);
    return;
  }
  EXPECT_NEAR(angle, 2.0 * pi, 0.02 * 2.0 * pi);
  EXPECT_NEAR(coverageOf(texels), 1.0, 2e-3);
}

TEST_P(HemisphereMaps, OpenReceiver_HasTheTransferOfAClampedCosine) {
  const gl::EglContext context;
  const CompiledScene scene = plateAbove(0.5f);
  HemisphereRaster raster(scene, GetParam(), 64);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));
  const HemisphereReceiver above{{0, 3, 0}, normal};
  const std::vector<double> found = raster.transfer(std::span(&above, 1), 4);
  std::vector<double> open(16);
  sh::openTransfer(normal, 4, open);
  for (std::size_t c = 0; c < 16; ++c) EXPECT_NEAR(found[c], open[c], coversAll() ? 2e-3 : 4e-3) << c;
}

TEST_P(HemisphereMaps, PlateAbove_HidesItsFormFactor) {
  const gl::EglContext context;
  const CompiledScene scene = plateAbove(1.0f);
  const HemisphereReceiver below{{0, 0, 0}, {0, 1, 0}};
  const double expected = 1.0 - plateShare(1.0);
  for (const int side : {32, 128}) {
    HemisphereRaster raster(scene, GetParam(), side);
    EXPECT_NEAR(openShare(raster.transfer(std::span(&below, 1), 1)), expected,
                side == 32    ? 0.03
                : coversAll() ? 0.008
                              : 0.018);
  }
}

TEST_P(HemisphereMaps, WallsThatGlowEvenly_GivePiTimesTheirRadiance) {
  const gl::EglContext context;
  const CompiledScene scene = room();
  const std::vector<glm::vec3> radiance(scene.vertexCount(), glm::vec3(2.0f, 1.0f, 0.5f));
  std::vector<HemisphereReceiver> receivers;
  for (int i = 0; i < 300; ++i)  // More than an atlas holds.
    receivers.push_back({{-1.5 + 0.01 * i, 0.3, 0.2},
                         glm::normalize(glm::dvec3(std::cos(i), std::sin(0.7 * i), std::sin(i)))});
  HemisphereRaster raster(scene, GetParam(), 32);
  for (const glm::vec3& value : raster.irradiance(receivers, radiance))
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c] / (pi * radiance[0][c]), 1.0, 2e-3);
}

TEST_P(HemisphereMaps, ReceiverOnAFloor_IsNotHiddenByIt) {
  const gl::EglContext context;
  const CompiledScene scene = plateAbove(1.0f);
  const glm::dvec3 up = glm::normalize(glm::dvec3(1e-4, 1.0, 2e-4));  // Off by as much as rounding.
  const HemisphereReceiver on{{0.31, 1.0, 0.17}, up};
  HemisphereRaster raster(scene, GetParam(), 64);
  EXPECT_NEAR(openShare(raster.transfer(std::span(&on, 1), 1)), 1.0, 2e-3);
}

TEST_P(HemisphereMaps, OneOfManyReceivers_SeesWhatItSeesAlone) {
  const gl::EglContext context;
  const CompiledScene scene = plateAbove(1.0f);
  std::vector<HemisphereReceiver> receivers;
  for (int i = 0; i < 20; ++i) receivers.push_back({{0.1 * i, 0.0, 0.05 * i}, {0, 1, 0}});
  HemisphereRaster raster(scene, GetParam(), 32);
  const std::vector<double> all = raster.transfer(receivers, 2);
  const std::vector<double> alone = raster.transfer(std::span(&receivers[13], 1), 2);
  for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(all[13 * 4 + c], alone[c]);
}

TEST_P(HemisphereMaps, BothOfOnePicture_AreAsDrawnApart) {
  const gl::EglContext context;
  const CompiledScene scene = plateAbove(1.0f);
  std::vector<glm::vec3> radiance;
  for (const glm::vec3& p : scene.positions) radiance.push_back(glm::abs(p) + glm::vec3(1.0f, 0.5f, 0.25f));
  std::vector<HemisphereReceiver> receivers;
  for (int i = 0; i < 300; ++i)  // More than an atlas holds.
    receivers.push_back(
        {{0.01 * i - 1.5, 0.0, 0.2}, glm::normalize(glm::dvec3(0.3 * std::sin(i), 1.0, 0.3 * std::cos(i)))});
  HemisphereRaster raster(scene, GetParam(), 32);
  const HemisphereGather both = raster.gather(receivers, 3, radiance);
  EXPECT_EQ(both.transfer, raster.transfer(receivers, 3));
  EXPECT_EQ(both.irradiance, raster.irradiance(receivers, radiance));
  EXPECT_GT(both.irradiance[150].x, 1.0f);
}

// Four passes give the plate's form factor, and for a slanted receiver the result of mip levels, except for
// the order of sums.
TEST_P(HemisphereMaps, SummedInFourPasses_FindTheSame) {
  const gl::EglContext context;
  const CompiledScene scene = plateAbove(1.0f);
  const std::vector<HemisphereReceiver> below = {{{0, 0, 0}, {0, 1, 0}},
                                                 {{0.4, -0.2, 0.3}, glm::normalize(glm::dvec3(1, 2, -1))}};
  const double hidden = plateShare(1.0);
  HemisphereRaster raster(scene, GetParam(), 32, HemisphereSums::FourPasses);
  const std::vector<double> found = raster.transfer(below, 4);
  EXPECT_NEAR(openShare(found), 1.0 - hidden, 0.03);
  HemisphereRaster mips(scene, GetParam(), 32);
  const std::vector<double> expected = mips.transfer(below, 4);
  for (std::size_t c = 0; c < found.size(); ++c) EXPECT_NEAR(found[c], expected[c], 1e-6) << c;
}

INSTANTIATE_TEST_SUITE_P(, HemisphereMaps,
                         ::testing::Values(HemisphereMap::Stereographic, HemisphereMap::Orthographic,
                                           HemisphereMap::HemiPlane, HemisphereMap::Hemicube,
                                           HemisphereMap::Tetrahedron),
                         [](const auto& info) {
                           std::string name = hemisphereMapNames[static_cast<std::size_t>(info.param)];
                           std::erase(name, '-');
                           return name;
                         });

// Each texel's direction is where a paraboloid mirror z = (1 - x^2 - y^2) / 2 reflects a ray along its axis.
TEST(StereographicMap, IsAParaboloidMirror) {
  constexpr int side = 16;
  const std::vector<HemisphereTexel> texels = texelsOf(HemisphereMap::Stereographic, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const glm::dvec2 p = glm::dvec2(x + 0.5, y + 0.5) * (2.0 / side) - 1.0;
      const glm::dvec3 mirror = glm::normalize(glm::dvec3(p, 1.0));  // gradient of the paraboloid
      const glm::dvec3 along(0.0, 0.0, -1.0), reflected = along - 2.0 * glm::dot(along, mirror) * mirror;
      EXPECT_LT(glm::distance(reflected, texels[static_cast<std::size_t>(y * side + x)].direction), 1e-12);
    }
}

/// Two triangles that stand upright at distance 1 from the origin, `height` high and of half width `half`.
CompiledScene wallOfTwoTriangles(float height, float half) {
  CompiledScene scene = test::sceneOf({{1, 0, -half}, {1, 0, half}, {1, height, half}, {1, height, -half}},
                                      {{0, 1, 2}, {0, 2, 3}});
  test::append(scene, test::ground(1, 0.01f, -1.0f));
  return scene;
}

struct DiscCase {
  HemisphereMap map;
  DiscEdges edges;
};

/// Share of the sky that a wall hides from the floor at its foot, of two maps and two sizes of walls.
double hiddenByWall(const CompiledScene& scene, DiscCase disc, int side) {
  HemisphereRaster raster(scene, disc.map, side, HemisphereSums::MipLevels, {}, disc.edges);
  const HemisphereReceiver floor{{0, 0, 0}, {0, 1, 0}, 0.3};
  return 1.0 - raster.look(std::span(&floor, 1), 1)[0].open;
}

// A wall without end, seen up to an angle above the horizon, hides (1 - its cosine) / 2.
TEST(DiscEdges, WallOfTwoTriangles_HidesItsFormFactor) {
  const gl::EglContext context;
  for (const float height : {0.25f, 1.0f, 4.0f}) {
    const CompiledScene scene = wallOfTwoTriangles(height, 2000.0f);
    const double expected = 0.5 * (1.0 - 1.0 / std::sqrt(1.0 + double(height) * height));
    for (const HemisphereMap map : {HemisphereMap::Stereographic, HemisphereMap::Orthographic}) {
      EXPECT_NEAR(hiddenByWall(scene, {map, DiscEdges::Exact}, 32), expected, 0.008) << height;
      EXPECT_NEAR(hiddenByWall(scene, {map, DiscEdges::Exact}, 128), expected, 0.002) << height;
    }
  }
}

// The straight lines between projected corners lose most of what coarse triangles hide.
TEST(DiscEdges, StraightOnes_LoseCoarseTriangles) {
  const gl::EglContext context;
  const CompiledScene scene = wallOfTwoTriangles(1.0f, 2000.0f);
  const double expected = 0.5 * (1.0 - std::sqrt(0.5));
  EXPECT_LT(hiddenByWall(scene, {HemisphereMap::Stereographic, DiscEdges::Projected}, 64), 0.7 * expected);
}

// A ball wholly above the horizon hides (radius / distance)^2 cosine.
TEST(DiscEdges, BallAboveAPlane_HidesItsFormFactor) {
  const gl::EglContext context;
  const glm::dvec3 centre(1.0, 1.5, 0.0);
  CompiledScene scene = test::sphere(48, 0.5f, glm::vec3(centre));
  test::append(scene, test::ground(2, 3.0f));
  const double distance = glm::length(centre);
  const double expected = 0.25 / (distance * distance) * centre.y / distance;
  for (const HemisphereMap map : {HemisphereMap::Stereographic, HemisphereMap::Orthographic}) {
    HemisphereRaster raster(scene, map, 64);
    double sum = 0.0;
    constexpr int turns = 16;
    for (int i = 0; i < turns; ++i) {
      const HemisphereReceiver below{{0, 1e-6, 0}, {0, 1, 0}, 2.0 * pi * i / turns};
      sum += 1.0 - raster.look(std::span(&below, 1), 1)[0].open;
    }
    EXPECT_NEAR(sum / turns, expected, 0.01 * expected);
  }
}

// The triangle hides (1 - cosine) / 2 of the hemisphere about a normal, with the cosine of the angle by which
// the normal leans from the triangle's.
TEST(DiscEdges, OwnTriangle_HidesWhatLiesBelowIt) {
  const gl::EglContext context;
  const CompiledScene scene = test::ground(1, 1.0f);
  for (const double angle : {0.0, 0.3, 0.8}) {
    const HemisphereReceiver leaning{
        {0.1, 1e-7, 0.3}, {std::sin(angle), std::cos(angle), 0.0}, 0.2, 0, glm::vec3(0, 1, 0)};
    HemisphereRaster raster(scene, HemisphereMap::Orthographic, 64);
    EXPECT_NEAR(1.0 - raster.look(std::span(&leaning, 1), 1)[0].open, 0.5 * (1.0 - std::cos(angle)), 0.004);
  }
}

TEST(DiscEdges, OpenReceiver_IsExactlyOpen) {
  const gl::EglContext context;
  const CompiledScene scene = plateAbove(0.5f);
  HemisphereRaster raster(scene, HemisphereMap::Stereographic, 32, HemisphereSums::FourPasses);
  const HemisphereReceiver above{{0, 3, 0}, {0, 1, 0}};
  const HemisphereView view = raster.look(std::span(&above, 1), 3)[0];
  EXPECT_EQ(view.open, 1.0f);
  EXPECT_EQ(glm::length(view.direction), 0.0f);
  ASSERT_EQ(view.harmonics.size(), 9u);
  for (const float value : view.harmonics) EXPECT_EQ(value, 0.0f);
}

/// A plate of half width 1 at height 1, whose material a test changes.
CompiledScene plateOf(const std::function<void(CompiledScene&)>& change) {
  CompiledScene scene = test::ground(2, 1.0f, 1.0f);
  for (std::size_t v = 0; v < scene.positions.size(); ++v)
    scene.texCoords[v] = 0.5f * (glm::vec2(scene.positions[v].x, scene.positions[v].z) + 1.0f);
  change(scene);
  return scene;
}

double openBelow(const CompiledScene& scene) {
  HemisphereRaster raster(scene, HemisphereMap::Orthographic, 64);
  const HemisphereReceiver below{{0, 0, 0}, {0, 1, 0}};
  return raster.look(std::span(&below, 1), 1)[0].open;
}

TEST(DiscHoles, OfAMask_AreOpen) {
  const gl::EglContext context;
  const CompiledScene masked = plateOf([](CompiledScene& scene) {
    Image image;
    image.width = 2;
    image.height = 1;
    image.rgba = {255, 255, 255, 0, 255, 255, 255, 255};
    scene.images = {image};
    scene.materials[0].alphaCutoff = 0.5f;
    scene.materials[0].baseColorTexture.image = 0;
    scene.materials[0].baseColorTexture.filter = TextureFilter::Nearest;
  });
  EXPECT_NEAR(openBelow(masked), 1.0 - 0.5 * plateShare(1.0), 0.006);
}

/// Returns the open share below a plate with one texel of a mask, at a coordinate beyond the image.
double openBelowMask(const std::vector<std::uint8_t>& alphas, float u, WrapMode wrap) {
  return openBelow(plateOf([&](CompiledScene& scene) {
    Image image;
    image.width = static_cast<int>(alphas.size());
    image.height = 1;
    for (const std::uint8_t alpha : alphas) image.rgba.insert(image.rgba.end(), {255, 255, 255, alpha});
    scene.images = {image};
    for (glm::vec2& coords : scene.texCoords) coords.x = u;
    scene.materials[0].alphaCutoff = 0.5f;
    TextureRef& texture = scene.materials[0].baseColorTexture;
    texture.image = 0;
    texture.filter = TextureFilter::Nearest;
    texture.wrapS = wrap;
  }));
}

TEST(DiscHoles, BelowTheFirstTexel_WrapAsKernelsDo) {
  const gl::EglContext context;
  const double hidden = 1.0 - plateShare(1.0);
  EXPECT_EQ(openBelowMask({0, 255}, -0.3f, WrapMode::ClampToEdge), 1.0);
  EXPECT_NEAR(openBelowMask({255, 0}, -0.3f, WrapMode::ClampToEdge), hidden, 0.006);
  // The last of three texels, which do not divide the number at which coordinates are folded.
  EXPECT_EQ(openBelowMask({255, 255, 0}, -0.1f, WrapMode::Repeat), 1.0);
  EXPECT_NEAR(openBelowMask({0, 0, 255}, -0.1f, WrapMode::Repeat), hidden, 0.006);
  const float none = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(openBelowMask({0, 255, 255}, none, WrapMode::Repeat), 1.0) << "the first texel";
}

TEST(DiscHoles, OfBlendedSurfaces_LetTheRestThrough) {
  const gl::EglContext context;
  const auto blended = [](float alpha) {
    return plateOf([alpha](CompiledScene& scene) {
      scene.texCoords.clear();  // as in scenes without textures
      scene.materials[0].alphaCutoff = 0.0f;
      scene.materials[0].blended = true;
      scene.materials[0].alphaFactor = alpha;
    });
  };
  EXPECT_NEAR(openBelow(blended(0.25f)), 1.0 - 0.25 * plateShare(1.0), 0.004);
  CompiledScene two = blended(0.5f);
  CompiledScene other = blended(0.5f);
  for (glm::vec3& p : other.positions) p *= 1.5f;  // the same directions behind the first
  test::append(two, other);
  EXPECT_NEAR(openBelow(two), 1.0 - 0.75 * plateShare(1.0), 0.008);
}

/// Directions beyond a plane that belong to each texel of its rim, by quadrature.
struct BesideTexels {
  std::vector<double> shares,
      cosines;  ///< [texel], share of an even sky's light and integral of the cosine over it.
};

BesideTexels besideByQuadrature(double halfWidth, int side) {
  BesideTexels beside{std::vector<double>(static_cast<std::size_t>(side * side), 0.0), {}};
  beside.cosines = beside.shares;
  constexpr int azimuths = 4000, heights = 2000;
  for (int i = 0; i < azimuths; ++i) {
    const double azimuth = 2.0 * pi * (i + 0.5) / azimuths;
    const glm::dvec2 away(std::cos(azimuth), std::sin(azimuth));
    const double reach = halfWidth / std::max(std::abs(away.x), std::abs(away.y));
    const glm::ivec2 at =
        glm::clamp(glm::ivec2((away * reach / halfWidth + 1.0) * 0.5 * double(side)), 0, side - 1);
    for (int k = 0; k < heights; ++k) {  // Even steps of the squared cosine.
      const double cosine = std::sqrt((k + 0.5) / heights);
      if (std::sqrt(1.0 - cosine * cosine) / cosine <= reach) continue;
      beside.shares[static_cast<std::size_t>(at.y * side + at.x)] += 1.0 / azimuths / heights;
      beside.cosines[static_cast<std::size_t>(at.y * side + at.x)] += cosine / azimuths / heights;
    }
  }
  return beside;
}

TEST(HemiPlane, LostShare_IsTheIntegralOfWhatItDoesNotSee) {
  for (const double halfWidth : {0.5, 1.0, 2.0, 2.25, 6.0}) {
    double integral = 0.0;
    for (const double share : besideByQuadrature(halfWidth, 1).shares) integral += share;
    EXPECT_NEAR(shareBeside({halfWidth}), integral, 5e-4) << halfWidth;
    EXPECT_NEAR(shareBeside({halfWidth}), 1.0 - plateShare(halfWidth), 1e-12) << halfWidth;
  }
  EXPECT_NEAR(shareBeside({1.0}), 1.0 - 0.56, 0.01);  // The top of a hemicube, as in the thesis.
}

TEST(HemiPlane, TexelsOfTheRim_TakeWhatLiesBehindThem) {
  constexpr int side = 8;
  for (const double halfWidth : {1.0, 2.25}) {
    const BesideTexels expected = besideByQuadrature(halfWidth, side);
    const std::vector<HemisphereTexel> texels = texelsOf(HemisphereMap::HemiPlane, side, {halfWidth});
    for (std::size_t t = 0; t < texels.size(); ++t) {
      EXPECT_NEAR(texels[t].shareBeside, expected.shares[t], 3e-4) << t;
      EXPECT_NEAR(texels[t].shareBeside * texels[t].beside.z, expected.cosines[t], 2e-4) << t;
      EXPECT_NEAR(glm::length(texels[t].beside), texels[t].shareBeside > 0.0 ? 1.0 : 0.0, 1e-12) << t;
    }
  }
}

TEST(HemiPlane, OpenReceiverWithTheMean_HasTheTransferOfWhatItSees) {
  const gl::EglContext context;
  const CompiledScene scene = plateAbove(0.5f);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));
  const HemisphereReceiver above{{0, 3, 0}, normal};
  HemisphereRaster raster(scene, HemisphereMap::HemiPlane, 64, HemisphereSums::MipLevels,
                          {2.25, LostLight::Mean});
  const std::vector<double> found = raster.transfer(std::span(&above, 1), 4), open = meanTransfer(normal);
  for (std::size_t c = 0; c < 16; ++c) EXPECT_NEAR(found[c], open[c], 2e-3) << c;
}

// A dark plate overhead in an evenly glowing room: the plate's form factor is exact, and everything that the
// hemi-plane misses glows.
TEST(HemiPlane, GlowBelowTheRim_IsLeftOutAveragedOrTaken) {
  const gl::EglContext context;
  CompiledScene scene = test::ground(8, 1.0f, 1.0f);
  std::vector<glm::vec3> radiance(scene.vertexCount(), glm::vec3(0.0f));
  test::append(scene, test::box(4, {-4, -4, -4}, {4, 4, 4}, true));
  radiance.resize(scene.vertexCount(), glm::vec3(1.0f));
  scene.boundsMin = {-4, -4, -4};
  scene.boundsMax = {4, 4, 4};
  const HemisphereReceiver below{{0, 0, 0}, {0, 1, 0}};
  const double plate = plateShare(1.0);
  const auto found = [&](HemiPlane plane) {
    HemisphereRaster raster(scene, HemisphereMap::HemiPlane, 128, HemisphereSums::MipLevels, plane);
    EXPECT_DOUBLE_EQ(raster.lostShare(), shareBeside(plane));
    return raster.irradiance(std::span(&below, 1), radiance)[0].x / pi;
  };
  for (const double halfWidth : {1.5, 2.25, 4.0}) {
    const double seen = plateShare(halfWidth);
    EXPECT_NEAR(found({halfWidth, LostLight::Dark}), seen - plate, 0.015) << halfWidth;
    EXPECT_NEAR(found({halfWidth, LostLight::Mean}), 1.0 - plate / seen, 0.015) << halfWidth;
    EXPECT_NEAR(found({halfWidth, LostLight::Rim}), 1.0 - plate, 0.015) << halfWidth;
  }
}

TEST(HemiPlane, WithoutWidth_IsRefused) {
  const gl::EglContext context;
  const CompiledScene scene = room();
  for (const double halfWidth : {0.0, -1.0, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(
        HemisphereRaster(scene, HemisphereMap::HemiPlane, 32, HemisphereSums::MipLevels, {halfWidth}), Error);
}

TEST(TexelSums, OfSquares_AreThoseOfDoublePrecision) {
  const gl::EglContext context;
  constexpr int pictureSide = 128;
  const gl::Framebuffer picture(pictureSide, pictureSide);
  std::vector<glm::vec4> texels;
  for (int t = 0; t < pictureSide * pictureSide; ++t)
    texels.emplace_back(std::sin(0.37 * t), 1.0 + std::cos(0.11 * t), 0.01 * (t % 97), t == 5000 ? 3.0 : 0.0);
  glBindTexture(GL_TEXTURE_2D, picture.color().name());
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, pictureSide, pictureSide, GL_RGBA, GL_FLOAT, texels.data());
  for (const int side : {8, 32, 64}) {
    const TexelSums sums(pictureSide, side);
    sums.run(picture.color());
    const std::vector<glm::vec4> found = sums.read();
    const int squares = pictureSide / side;
    ASSERT_EQ(found.size(), static_cast<std::size_t>(squares * squares));
    std::vector<glm::dvec4> expected(found.size(), glm::dvec4(0.0));
    for (int t = 0; t < pictureSide * pictureSide; ++t)
      expected[static_cast<std::size_t>(t / pictureSide / side * squares + t % pictureSide / side)] +=
          glm::dvec4(texels[static_cast<std::size_t>(t)]);
    for (std::size_t i = 0; i < found.size(); ++i)
      for (int c = 0; c < 4; ++c) EXPECT_NEAR(found[i][c], expected[i][c], 4e-7 * side * side) << side;
  }
}

TEST(TexelSums, OfTheThesisSquares_AreOfEightAndFourTexels) {
  const gl::EglContext context;
  EXPECT_EQ(TexelSums(64, 32).counts(), (std::array<int, 4>{8, 4, 8, 4}));
}

TEST(HemisphereRaster, OddSide_IsRefused) {
  const gl::EglContext context;
  const CompiledScene scene = room();
  EXPECT_THROW(HemisphereRaster(scene, HemisphereMap::Hemicube, 33), Error);
  EXPECT_THROW(HemisphereRaster(scene, HemisphereMap::Hemicube, 4), Error);
}

}  // namespace
}  // namespace prelight::viewer

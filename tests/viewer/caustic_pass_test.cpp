#include "viewer/techniques/caustics/caustic_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "base/directions.h"
#include "photon/density_estimator.h"
#include "support/devices.h"
#include "viewer/frame/view.h"
#include "viewer/gl/egl_context.h"
#include "viewer/picture_checks.h"
#include "viewer/programs/texture_units.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using device::Photon;
using namespace test;

using std::numbers::pi;
constexpr double spotWidth = 0.12;  // Standard deviation, m.

/// A white square under a black sky, with photons of 1 W in all that form a round spot on it.
struct Spot {
  explicit Spot(std::size_t count = 40000, float half = 1.0f) {
    quad.add(lambertian(glm::vec3(1.0f)), half);
    Environment black{4, 2, std::vector<glm::vec3>(8, glm::vec3(0.0f))};
    quad.setSky(black);
    std::mt19937 random(1);
    std::normal_distribution<double> place(0.0, spotWidth);
    while (photons.size() < count) {
      const double x = place(random), y = place(random);
      if (std::abs(x) > static_cast<double>(half) || std::abs(y) > static_cast<double>(half)) continue;
      add(x, y, 1.0 / static_cast<double>(count), {0, 0, 1});
    }
    filter.radius = 0.15;
    filter.density.nearest = 100;
  }

  void add(double x, double y, double power, const glm::dvec3& from) {
    const float watts = static_cast<float>(power);
    photons.push_back({{static_cast<float>(x), static_cast<float>(y), 0.0f},
                       0,
                       {watts, 0.5f * watts, 0.0f},
                       packDirection(from)});
  }

  Picture picture(const glm::dvec3& eye, int size, int samplesPerAxis = 1, bool skipCells = true,
                  const glm::dvec3& target = glm::dvec3(0.0)) {
    quad.scene.cameras.clear();
    quad.lookFrom(eye, target);
    quad.compile();
    const viewer::Caustics caustics{photons, filter, skipCells};
    viewer::RenderInputs inputs = quad.inputs();
    inputs.caustics = &caustics;
    viewer::RenderOptions options = square(viewer::Shading::Phong, size);
    options.samplesPerAxis = samplesPerAxis;
    Warnings notes;
    return viewer::renderPicture(inputs, options, notes);
  }

  /// Power on the square according to a picture, W: irradiance times the area that each pixel sees.
  double shownPower(const Picture& picture, const glm::dvec3& eye) const {
    const viewer::CameraMatrices camera = viewer::cameraMatrices(quad.scene.cameras[0], quad.compiled, 1.0);
    const glm::dmat3 axes(glm::transpose(glm::dmat3(camera.view)));
    const double half = std::tan(0.5 * quad.scene.cameras[0].yFov);
    double sum = 0.0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const glm::dvec3 ray = camera.forward + axes[0] * half * ((2.0 * x + 1.0) / picture.width - 1.0) -
                               axes[1] * half * ((2.0 * y + 1.0) / picture.height - 1.0);
        if (ray.z >= 0.0) continue;
        const double depth = -eye.z / ray.z, pixel = 2.0 * half / picture.width;
        const float red = picture.pixels[static_cast<std::size_t>(y) * picture.width + x].r;
        sum += pi * static_cast<double>(red) * pixel * pixel * depth * depth / -ray.z;
      }
    return sum;
  }

  QuadScene quad;
  std::vector<Photon> photons;
  CausticFilter filter;
};

TEST(CausticPass, Power_IsTheSameFromAnyDistanceAndAngle) {
  Spot spot;
  for (const glm::dvec3 eye :
       {glm::dvec3(0, 0, 2.2), {0, 0, 4.5}, {0, 0, 9}, {2, 0, 2}, {0, 3, 0.8}, {1.5, -2.0, 1.5}}) {
    const Picture picture = spot.picture(eye, 200);
    EXPECT_NEAR(spot.shownPower(picture, eye), 1.0, 0.02) << eye.x << ' ' << eye.y << ' ' << eye.z;
  }
}

TEST(CausticPass, Irradiance_IsThatOfTheWorldSpaceFilter) {
  Spot spot;
  const glm::dvec3 eye(0.3, -1.2, 1.6);
  const int size = 160;
  const Picture picture = spot.picture(eye, size);
  const SurfaceRegions regions = makeSurfaceRegions(spot.quad.compiled, usualCreaseAngle);
  const DensitySurface surface = makeDensitySurface(spot.quad.compiled, regions);
  DensityEstimator estimator(surface, spot.filter.density, sharedDevice());
  estimator.setPhotons(makePhotonMaps(spot.photons, surface));
  const viewer::CameraMatrices camera =
      viewer::cameraMatrices(spot.quad.scene.cameras[0], spot.quad.compiled, 1.0);
  const glm::dmat3 axes(glm::transpose(glm::dmat3(camera.view)));
  const double half = std::tan(0.5 * spot.quad.scene.cameras[0].yFov);
  std::vector<device::DensityQuery> queries;
  std::vector<double> shown, exact;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const glm::dvec3 ray = camera.forward + axes[0] * half * ((2.0 * x + 1.0) / size - 1.0) -
                             axes[1] * half * ((2.0 * y + 1.0) / size - 1.0);
      const glm::dvec3 p = eye - ray * (eye.z / ray.z);
      if (std::hypot(p.x, p.y) > 2.0 * spotWidth) continue;
      queries.push_back({{static_cast<float>(p.x), static_cast<float>(p.y), 0.0f},
                         0,
                         {0, 0, 1},
                         static_cast<float>(spot.filter.radius),
                         PRELIGHT_WHOLE_REGION});
      shown.push_back(pi * static_cast<double>(picture.pixels[static_cast<std::size_t>(y) * size + x].r));
      exact.push_back(std::exp(-0.5 * (p.x * p.x + p.y * p.y) / (spotWidth * spotWidth)) /
                      (2.0 * pi * spotWidth * spotWidth));
    }
  ASSERT_GT(queries.size(), 1000u);
  const std::vector<glm::vec3> world = estimator.estimate(queries);
  double difference = 0.0, worldError = 0.0, screenError = 0.0, scale = 0.0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    difference += std::pow(shown[i] - static_cast<double>(world[i].x), 2.0);
    worldError += std::pow(static_cast<double>(world[i].x) - exact[i], 2.0);
    screenError += std::pow(shown[i] - exact[i], 2.0);
    scale += exact[i] * exact[i];
  }
  // Relative noise of the kernel over k photons.
  const double noise = std::sqrt(4.0 / (3.0 * spot.filter.density.nearest));
  EXPECT_LT(std::sqrt(difference / scale), noise);
  EXPECT_LT(std::sqrt(screenError / scale), 1.2 * noise);
  EXPECT_LT(std::sqrt(worldError / scale), 1.2 * noise);
}

TEST(CausticPass, SquaresEdge_IsNoDarker) {
  Spot spot(0);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  for (int i = 0; i < 100000; ++i) spot.add(place(random), place(random), 4.0 / 100000, {0, 0, 1});
  const Picture picture = spot.picture({0, 0, 3.0}, 150);
  const double half = 3.0 * std::tan(0.5 * spot.quad.scene.cameras[0].yFov);  // Half of the visible width, m.
  double sum = 0.0;
  int count = 0;
  for (int y = 0; y < 150; ++y)
    for (int x = 0; x < 150; ++x) {
      const double u = half * ((x + 0.5) / 75.0 - 1.0), v = half * ((y + 0.5) / 75.0 - 1.0);
      const double edge = std::max(std::abs(u), std::abs(v));
      if (edge > 0.995 || edge < 0.97) continue;
      sum += pi * static_cast<double>(picture.pixels[static_cast<std::size_t>(y) * 150 + x].r);
      ++count;
    }
  ASSERT_GT(count, 100);
  EXPECT_NEAR(sum / count, 1.0, 0.03);
}

/// Scatter of irradiance over a picture relative to its mean.
double relativeScatter(const Picture& picture) {
  double sum = 0.0, squares = 0.0;
  for (const glm::vec3& pixel : picture.pixels) {
    const double irradiance = pi * static_cast<double>(pixel.r);
    sum += irradiance;
    squares += irradiance * irradiance;
  }
  const double mean = sum / static_cast<double>(picture.pixels.size());
  return std::sqrt(squares / static_cast<double>(picture.pixels.size()) - mean * mean) / mean;
}

// 100 photons lie within 36 mm: 18, 60 and 180 pixels of these pictures.
TEST(CausticPass, NearView_HasNoMoreNoiseThanItsPhotons) {
  Spot spot(0);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  for (int i = 0; i < 100000; ++i) spot.add(place(random), place(random), 4.0 / 100000, {0, 0, 1});
  const double noise = std::sqrt(4.0 / (3.0 * spot.filter.density.nearest));
  for (const double height : {0.5, 0.15, 0.05})
    EXPECT_LT(relativeScatter(spot.picture({0, 0, height}, 200)), 1.2 * noise) << height;
}

TEST(CausticLevels, NearPhoton_NeedsLevelsThatItsRadiusFits) {
  Spot spot;
  spot.quad.scene.cameras.clear();
  spot.quad.lookFrom({0, 0, 2}, {0, 0, 0});
  spot.quad.compile();
  const viewer::CameraMatrices camera =
      viewer::cameraMatrices(spot.quad.scene.cameras[0], spot.quad.compiled, 1.0);
  const std::vector<glm::vec3> centre = {{0, 0, 0}}, behind = {{0, 0, 5}};
  const auto levels = [&](const std::vector<glm::vec3>& points, double pixels) {
    return viewer::levelsForRadius(points, 2.0 * pixels * 0.01, camera, 0.01, 8, 6);
  };
  EXPECT_EQ(levels(centre, 7.9), 1);
  EXPECT_EQ(levels(centre, 8.1), 2);
  EXPECT_EQ(levels(centre, 60.0), 4);
  EXPECT_EQ(levels(centre, 1e6), 6);
  EXPECT_EQ(levels(behind, 60.0), 1);
}

TEST(CausticLevels, RastersOfTiles_LieOnOneGrid) {
  for (const viewer::Tile tile : {viewer::Tile{0, 0, 100, 70}, {100, 3, 33, 64}, {1, 700, 1, 20}})
    for (const int level : {0, 1, 3, 5}) {
      const int texel = viewer::pixelsPerTexel(level);
      const viewer::LevelRaster raster = viewer::rasterAround(tile, 720, level, 8);
      EXPECT_EQ(raster.left % texel, 0);
      EXPECT_EQ(raster.bottom % texel, 0);
      const viewer::Tile covered = raster.tile(720);
      EXPECT_LE(covered.x + 8 * texel, tile.x);
      EXPECT_LE(covered.y + 8 * texel, tile.y);
      EXPECT_GE(covered.x + covered.width - 8 * texel, tile.x + tile.width);
      EXPECT_GE(covered.y + covered.height - 8 * texel, tile.y + tile.height);
    }
}

TEST(CausticPass, PhotonsOnTheBack_AreNotSeenFromTheFront) {
  Spot spot(0);
  for (int i = 0; i < 1000; ++i) spot.add(0.001 * i - 0.5, 0.0, 1e-3, {0, 0, -1});
  const Picture picture = spot.picture({0, 0, 3}, 60);
  for (const glm::vec3& pixel : picture.pixels) ASSERT_EQ(pixel.r, 0.0f);
}

TEST(CausticPass, SkippedCells_ChangeNothing) {
  Spot spot(5000);
  const Picture skipped = spot.picture({1, -1, 2}, 300), all = spot.picture({1, -1, 2}, 300, 1, false);
  EXPECT_EQ(skipped.pixels, all.pixels);
  double brightest = 0.0;
  for (const glm::vec3& pixel : skipped.pixels) brightest = std::max(brightest, static_cast<double>(pixel.r));
  EXPECT_GT(brightest, 1.0);
}

/// Share of the pixels of the caustics that surfaces read which were filtered.
double filteredShare() {
  glActiveTexture(GL_TEXTURE0 + viewer::causticsUnit);
  GLint width = 0, height = 0;
  glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
  glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &height);
  std::vector<glm::vec4> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, pixels.data());
  const auto filtered = std::ranges::count_if(pixels, [](const glm::vec4& p) { return p.a > 0.0f; });
  return static_cast<double>(filtered) / static_cast<double>(pixels.size());
}

TEST(CausticPass, FewPhotons_FilterFewCells) {
  Spot spot(3000);
  spot.quad.lookFrom({0, 0, 4}, {0, 0, 0});
  spot.quad.compile();
  const viewer::Caustics caustics{spot.photons, spot.filter};
  viewer::RenderInputs inputs = spot.quad.inputs();
  inputs.caustics = &caustics;
  viewer::RenderOptions options = square(viewer::Shading::Phong, 512);
  const viewer::View view = viewer::makeView(inputs, options);
  const viewer::gl::EglContext context;
  viewer::Renderer renderer(inputs);
  std::optional<double> share;
  renderer.observePasses([&](const viewer::DrawnPass& drawn) {
    if (drawn.pass == viewer::FramePass::Caustics) share = filteredShare();
  });
  viewer::renderView(renderer, view, 1);
  ASSERT_TRUE(share.has_value());
  EXPECT_GT(*share, 0.02);
  EXPECT_LT(*share, 0.25);
}

TEST(CausticPass, TilesOfAPicture_HaveNoSeam) {
  Spot spot(200000);
  spot.filter.radius = 0.003;
  spot.filter.density.nearest = 1000;  // In effect, the radius is used everywhere.
  // The middle of the spot lies on the seam of tiles, at pixel 1024 of two samples per side.
  constexpr int size = 1200, seam = 1024;
  spot.quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
  const double half = 2.5 * std::tan(0.5 * spot.quad.scene.cameras[0].yFov);
  const glm::dvec3 target(-half * (2.0 * seam / size - 1.0), 0, 0), eye = target + glm::dvec3(0, 0, 2.5);
  const Picture picture = spot.picture(eye, size, 2, true, target);
  const auto column = [&](int x) {
    double sum = 0.0;
    for (int y = 0; y < size; ++y)
      sum += static_cast<double>(picture.pixels[static_cast<std::size_t>(y) * size + x].r);
    return sum;
  };
  double left = 0.0, right = 0.0, near = 0.0;
  for (int x = 0; x < 6; ++x) {
    left += column(seam - 40 + x);
    near += column(seam - 3 + x);
    right += column(seam + 34 + x);
  }
  // 6 columns hold 7000 photons; the tolerance is four standard deviations of a ratio.
  EXPECT_NEAR(2.0 * near / (left + right),
              std::exp(0.5 * std::pow(37.0 * 2.0 * half / size / spotWidth, 2.0)), 0.07);
  EXPECT_GT(spot.shownPower(picture, eye), 0.97);
}

}  // namespace
}  // namespace prelight

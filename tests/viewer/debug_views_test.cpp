#include "viewer/debug/debug_views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <tuple>

#include "gi/update/live_light.h"
#include "gi/update/live_scenes.h"
#include "support/devices.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using test::pixelAt;
using test::QuadScene;
using test::square;
using ::testing::HasSubstr;
using viewer::DebugView;
using viewer::RenderInputs;
using viewer::RenderOptions;
using viewer::Shading;

constexpr int size = 65;         ///< pixels; edges at halves and quarters pass near their centres
constexpr float dimmed = 0.35f;  ///< of a picture below marks, as drawMarks() says
const glm::vec3 none(0.03f);     ///< of what has no texels

/// Views of squares of the plane z = 0 that fill the picture: a point (x, y) of -1..1 lies at the pixel
/// (1 + x) / 2, (1 - y) / 2 of its size.
class DebugViews : public testing::Test {
 protected:
  DebugViews() {
    quads_.lookFrom({0, 0, 3}, {0, 0, 0});
    quads_.scene.cameras.front().yFov = 2.0 * std::atan(1.0 / 3.0);
    quads_.setSky(constantEnvironment(glm::vec3(0.5f)));
  }

  void addSquare(float half, double x = 0.0, const glm::vec3& albedo = glm::vec3(0.6f)) {
    glm::dmat4 place(1.0);
    place[3] = glm::dvec4(x, 0.0, 0.0, 1.0);
    quads_.add(test::lambertian(albedo), half, place);
  }

  static RenderOptions options(DebugView view = DebugView::None) {
    RenderOptions options = square(Shading::Phong, size);
    options.samplesPerAxis = 1;
    options.debug.shown = view;
    return options;
  }

  Picture draw(const RenderOptions& options) {
    notes_.clear();
    return viewer::renderPicture(inputs_ ? *inputs_ : quads_.inputs(), options, notes_);
  }
  Picture draw(DebugView view) { return draw(options(view)); }

  /// The pixel at which a point of the plane is seen.
  static glm::vec3 at(const Picture& picture, double x, double y) {
    return pixelAt(picture, 0.5 + 0.5 * x, 0.5 - 0.5 * y);
  }

  /// A map in which every square of the scene is a chart of `texels` texels a side.
  void mapSquares(const std::vector<int>& texels) {
    LightMap& map = quads_.bake.lightMap.emplace();
    LightMapLayout& layout = map.layout;
    for (const int side : texels) {
      layout.width += side;
      layout.height = std::max(layout.height, side);
    }
    const std::size_t triangles = quads_.compiled.triangleCount();
    layout.corners.resize(6 * triangles);
    layout.chartOf.assign(2 * triangles, LightMapLayout::noChart);
    float left = 0.0f;
    for (std::uint32_t chart = 0; chart < texels.size(); ++chart) {
      const auto side = static_cast<float>(texels[chart]);
      const glm::vec2 corners[] = {{left, side}, {left + side, side}, {left + side, 0.0f}, {left, 0.0f}};
      const int faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
      for (std::uint32_t t = 0; t < 2; ++t) {
        layout.chartOf[2 * chart + t] = chart;
        for (std::size_t k = 0; k < 3; ++k) layout.corners[3 * (2 * chart + t) + k] = corners[faces[t][k]];
      }
      for (int y = 0; y < texels[chart]; ++y)
        for (int x = 0; x < texels[chart]; ++x)
          layout.texels.push_back({static_cast<std::uint32_t>(y * layout.width + int(left) + x),
                                   2 * chart + (x < y ? 0u : 1u), 0.3f, 0.3f});
      left += side;
    }
    layout.chartCount = static_cast<std::uint32_t>(texels.size());
    map.values.assign(3 * layout.texelCount(), 1.0f);
  }

  std::set<std::tuple<float, float, float>> colorsOf(const Picture& picture) {
    std::set<std::tuple<float, float, float>> colors;
    for (const glm::vec3& p : picture.pixels) colors.emplace(p.x, p.y, p.z);
    return colors;
  }

  QuadScene quads_;
  std::optional<RenderInputs> inputs_;  ///< none: those of the squares
  Warnings notes_;
};

/// Expects pixels for which `isMarked` holds, given their point of the plane, to be marked, and all others
/// to be those of the plain picture, dimmed.
void expectMarks(const Picture& marked, const Picture& plain,
                 const std::function<double(double, double)>& distance) {
  const double pixel = 2.0 / size;
  int marks = 0;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const double x = (column + 0.5) * pixel - 1.0, y = 1.0 - (row + 0.5) * pixel;
      const std::size_t i = static_cast<std::size_t>(row) * size + column;
      const bool isPlain = glm::length(marked.pixels[i] - dimmed * plain.pixels[i]) < 1e-3f;
      if (distance(x, y) < 0.3 * pixel) {
        EXPECT_FALSE(isPlain) << "no mark at " << x << ", " << y;
        ++marks;
      }
      if (distance(x, y) > 2.5 * pixel) {
        EXPECT_TRUE(isPlain) << "a mark at " << x << ", " << y;
      }
    }
  EXPECT_GT(marks, 0);
}

TEST_F(DebugViews, Wireframe_LinesLieOnEdgesAlone) {
  addSquare(0.5f);
  quads_.compile();
  const Picture plain = draw(DebugView::None), lines = draw(DebugView::Wireframe);
  expectMarks(lines, plain, [](double x, double y) {
    const double outside = std::max(std::abs(x), std::abs(y)) - 0.5;
    const double diagonal = outside < 0.0 ? std::abs(x - y) / std::sqrt(2.0) : 1.0;
    const double edge = std::abs(outside);
    return std::min(edge, diagonal);
  });
  EXPECT_THAT(notes_, testing::Contains(HasSubstr("2 triangles, 5 edges")));
}

TEST_F(DebugViews, Photons_AppearAtTheirProjectedPixels) {
  addSquare(1.0f);
  quads_.compile();
  const std::vector<device::Photon> photons = {{{0.5f, 0.25f, 0.0f}, 0, {2.0f, 1.0f, 0.0f}, 0},
                                               {{-0.75f, -0.5f, 0.0f}, 0, {0.0f, 0.0f, 3.0f}, 0}};
  const viewer::Caustics caustics{photons, {}};
  inputs_.emplace(quads_.inputs());
  inputs_->caustics = &caustics;
  const Picture drawn = draw(DebugView::Photons), plain = draw(DebugView::None);
  test::expectColor(at(drawn, 0.5, 0.25), {0.8, 0.4, 0.0}, 1e-3);
  test::expectColor(at(drawn, -0.75, -0.5), {0.0, 0.0, 0.8}, 1e-3);
  test::expectColor(at(drawn, 0.0, 0.8), dimmed * at(plain, 0.0, 0.8), 1e-3);
}

/// A photon behind a surface is hidden by it.
TEST_F(DebugViews, PhotonBehindASurface_IsHidden) {
  addSquare(1.0f);
  quads_.compile();
  const std::vector<device::Photon> photons = {{{0.5f, 0.25f, -0.2f}, 0, {2.0f, 1.0f, 0.0f}, 0}};
  const viewer::Caustics caustics{photons, {}};
  inputs_.emplace(quads_.inputs());
  inputs_->caustics = &caustics;
  const Picture drawn = draw(DebugView::Photons), plain = draw(DebugView::None);
  for (std::size_t i = 0; i < drawn.pixels.size(); ++i)
    EXPECT_LT(glm::length(drawn.pixels[i] - dimmed * plain.pixels[i]), 1e-4f) << "pixel " << i;
}

/// The photon's own cell of 8 x 8 pixels and its neighbours are filtered; what is farther stays as it is.
TEST_F(DebugViews, CausticCells_AreThoseOfPhotonsAndTheirNeighbours) {
  addSquare(1.0f);
  quads_.compile();
  const std::vector<device::Photon> photons = {{{0.1f, 0.1f, 0.0f}, 0, {1.0f, 1.0f, 1.0f}, 0}};
  const viewer::Caustics caustics{photons, {}};
  inputs_.emplace(quads_.inputs());
  inputs_->caustics = &caustics;
  const Picture drawn = draw(DebugView::CausticCells), plain = draw(DebugView::None);
  int orange = 0, blue = 0;
  for (std::size_t i = 0; i < drawn.pixels.size(); ++i) {
    const glm::vec3 more = drawn.pixels[i] - plain.pixels[i];
    if (glm::length(more) < 1e-4f) continue;
    ++(drawn.pixels[i].x > drawn.pixels[i].z ? orange : blue);
  }
  EXPECT_EQ(orange, 64);
  EXPECT_EQ(blue, 8 * 64);
  EXPECT_GT(at(drawn, 0.1, 0.1).x, at(drawn, 0.1, 0.1).z);
  test::expectColor(at(drawn, -0.8, -0.8), at(plain, -0.8, -0.8), 1e-5);
}

TEST_F(DebugViews, Charts_HaveAsManyColoursAsThereAre) {
  addSquare(0.3f, -0.6);
  addSquare(0.3f, 0.0);
  addSquare(0.3f, 0.6);
  quads_.compile();
  mapSquares({4, 4});  // the third square has no chart
  const Picture drawn = draw(DebugView::Charts);
  EXPECT_EQ(colorsOf(drawn).size(), 4u) << "two charts, what has none, and the background";
  EXPECT_GT(glm::length(at(drawn, -0.6, 0.0) - at(drawn, 0.0, 0.0)), 0.2f);
  test::expectColor(at(drawn, 0.6, 0.0), none, 1e-5);
  test::expectColor(at(drawn, 0.0, 0.9), glm::vec3(0.0f), 1e-5);
  EXPECT_THAT(notes_, testing::Contains(HasSubstr("2 charts of 16 to 16 texels, in a map of 8 x 4")));
}

TEST_F(DebugViews, Texels_AlternateWithinAChart) {
  addSquare(1.0f);
  quads_.compile();
  mapSquares({4});
  const Picture drawn = draw(DebugView::Texels);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const glm::vec3 here = pixelAt(drawn, (column + 0.5) / 4, (row + 0.5) / 4),
                      first = pixelAt(drawn, 0.125, 0.125);
      const float expected = (row + column) % 2 == 0 ? 1.0f : 0.35f;
      test::expectColor(here, expected * first, 1e-4);
    }
  EXPECT_EQ(colorsOf(drawn).size(), 2u);
}

/// A chart with twice as many texels on the same square is red, the other blue.
TEST_F(DebugViews, TexelDensity_GoesFromBlueToRed) {
  addSquare(0.4f, -0.5);
  addSquare(0.4f, 0.5);
  quads_.compile();
  mapSquares({4, 8});
  const Picture drawn = draw(DebugView::TexelDensity);
  const glm::vec3 few = at(drawn, -0.5, 0.0), many = at(drawn, 0.5, 0.0);
  EXPECT_GT(few.z, 4.0f * few.x);
  EXPECT_GT(many.x, 4.0f * many.z);
  EXPECT_THAT(notes_, testing::Contains(HasSubstr("blue 5, red 10 texels per metre")));
}

TEST_F(DebugViews, Normals_AreColoursOfTheirAxes) {
  addSquare(0.5f);
  quads_.compile();
  const Picture drawn = draw(DebugView::Normals);
  test::expectColor(at(drawn, 0.1, 0.0), {0.5, 0.5, 1.0}, 1e-5);
  test::expectColor(at(drawn, 0.8, 0.0), glm::vec3(0.0f), 1e-5);
}

TEST_F(DebugViews, Albedo_DependsOnNoLight) {
  addSquare(1.0f, 0.0, {0.2f, 0.5f, 0.7f});
  quads_.compile();
  RenderOptions dark = options(DebugView::Albedo);
  dark.lights.emplace();
  test::expectColor(pixelAt(draw(dark)), {0.2, 0.5, 0.7}, 1e-5);
}

TEST_F(DebugViews, Exposure_LeavesColoursAsTheyAreDisplayed) {
  addSquare(1.0f, 0.0, {0.2f, 0.5f, 0.7f});
  quads_.compile();
  RenderOptions bright = options(DebugView::Albedo);
  bright.debug.exposure = 4.0;
  test::expectColor(4.0f * pixelAt(draw(bright)), {0.2, 0.5, 0.7}, 1e-5);
}

TEST_F(DebugViews, Regions_ApartFromEachOther_HaveTheirOwnColours) {
  addSquare(0.3f, -0.5);
  addSquare(0.3f, 0.5);
  quads_.compile();
  EXPECT_EQ(colorsOf(draw(DebugView::Regions)).size(), 3u) << "two regions and the background";
}

/// The root's box of a flat scene is its outline.
TEST_F(DebugViews, Tree_AtItsRoot_IsTheBoundingBox) {
  addSquare(0.25f, -0.25);
  addSquare(0.25f, 0.25);
  quads_.compile();
  RenderOptions root = options(DebugView::Tree);
  root.debug.treeDepth = 0;
  expectMarks(draw(root), draw(DebugView::None),
              [](double x, double y) { return std::abs(std::max(std::abs(x) - 0.5, std::abs(y) - 0.25)); });
  EXPECT_THAT((draw(root), notes_), testing::Contains(HasSubstr("1 boxes at level 0")));
}

TEST_F(DebugViews, Receivers_OfALightMap_AreOneInEachTexel) {
  addSquare(0.5f);
  quads_.compile();
  mapSquares({2});
  const Picture drawn = draw(DebugView::Receivers), plain = draw(DebugView::None);
  // All four texels of the test have the same weights of the corners of one of the triangles.
  for (const glm::vec2 place : {glm::vec2(0.1f, -0.2f), glm::vec2(-0.2f, 0.1f)})
    EXPECT_GT(at(drawn, place.x, place.y).x, 2.0f * at(drawn, place.x, place.y).z) << place.x;
  test::expectColor(at(drawn, 0.4, 0.0), dimmed * at(plain, 0.4, 0.0), 1e-3);
  EXPECT_THAT((draw(DebugView::Receivers), notes_),
              testing::Contains(HasSubstr("4 receivers, one in each texel")));
}

TEST_F(DebugViews, Receivers_WithoutALightMap_LieOnTheSurface) {
  addSquare(0.5f);
  quads_.compile();
  const Picture drawn = draw(DebugView::Receivers), plain = draw(DebugView::None);
  int marks = 0;
  for (int i = 0; i < size * size; ++i) {
    if (glm::length(drawn.pixels[i] - dimmed * plain.pixels[i]) < 1e-3f) continue;
    ++marks;
    EXPECT_LT(std::abs((i % size + 0.5) * 2.0 / size - 1.0), 0.6);
    EXPECT_LT(std::abs((i / size + 0.5) * 2.0 / size - 1.0), 0.6);
  }
  EXPECT_GT(marks, 4);
}

TEST_F(DebugViews, Probes_AreGreenInTheAirAndRedInsideObjects) {
  addSquare(1.0f);
  quads_.compile();
  VolumeTransfer& volume = quads_.bake.volume.emplace();
  volume.grid = {{2, 1, 1}, {-0.5, -0.25, 0.0}, {0.5, 0.25, 0.01}};
  volume.order = 1;
  volume.coefficients.assign(2, 1.0f);
  volume.air = {1, 0};
  const Picture drawn = draw(DebugView::Probes);
  const glm::vec3 air = at(drawn, -0.25, 0.0), inside = at(drawn, 0.25, 0.0);
  EXPECT_GT(air.y, 3.0f * air.x);
  EXPECT_GT(inside.x, 3.0f * inside.y);
}

TEST_F(DebugViews, ViewWithoutItsData_SaysWhatIsMissing) {
  addSquare(1.0f);
  quads_.compile();
  const auto messageOf = [&](DebugView view) -> std::string {
    try {
      draw(view);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(messageOf(DebugView::Photons),
              testing::AllOf(HasSubstr("--debug photons"), HasSubstr("no photons are stored"),
                             HasSubstr("--shading full")));
  EXPECT_THAT(messageOf(DebugView::Charts),
              testing::AllOf(HasSubstr("there is no light map"), HasSubstr("--shading lightmap")));
  EXPECT_THAT(messageOf(DebugView::Probes), HasSubstr("the bake has no volume"));
  EXPECT_THAT(messageOf(DebugView::Priority), HasSubstr("no indirect light follows the scene"));
  EXPECT_THAT(
      viewer::offeredDebugViews(quads_.inputs()),
      testing::ElementsAre(DebugView::None, DebugView::Normals, DebugView::Uv, DebugView::Albedo,
                           DebugView::Wireframe, DebugView::Regions, DebugView::Tree, DebugView::Receivers));
}

TEST_F(DebugViews, Pictures_HaveNoLayers) {
  addSquare(1.0f);
  quads_.compile();
  std::vector<PictureChannel> layers;
  viewer::renderPicture(quads_.inputs(), options(DebugView::Wireframe), notes_, nullptr, &layers);
  EXPECT_TRUE(layers.empty());
  viewer::renderPicture(quads_.inputs(), options(), notes_, nullptr, &layers);
  EXPECT_FALSE(layers.empty());
}

/// Light that follows a room: texels wait once its lamp has moved, and only then.
TEST_F(DebugViews, LightThatFollows_ShowsItsStateInPhotonsAndTexels) {
  const test::LoadedScene loaded("rooms");
  LiveLightOptions small;
  small.photons = 500;
  small.texels = 200;
  small.gather.rays = 8;
  small.gather.texelsPerFrame = 1;
  small.causticPhotons = 100;
  Progress progress;
  LiveLight live(loaded.scene, loaded.compiled, nullptr, 0.0, small, std::span<const int>(),
                 test::sharedDevice(), progress);
  const GlobalIllumination start = illuminationOf(live);
  inputs_.emplace(RenderInputs{
      .scene = loaded.scene, .compiled = loaded.compiled, .globalIllumination = &start, .live = &live});
  draw(DebugView::Priority);
  EXPECT_THAT(notes_, testing::Contains(HasSubstr("priority: 0 of ")));
  Light lamp = loaded.compiled.lights.at(0);
  lamp.intensity *= 0.2f;
  live.setLight(0, lamp);
  live.advance(progress);
  const Picture waiting = draw(DebugView::Priority);
  EXPECT_THAT(notes_, testing::Not(testing::Contains(HasSubstr("priority: 0 of "))));
  EXPECT_GT(test::largest(waiting), 0.3);
  draw(DebugView::PhotonGroups);
  EXPECT_THAT(notes_,
              testing::Contains(HasSubstr(std::to_string(live.photons()->photons().size()) + " photons in " +
                                          std::to_string(live.photons()->groupCount()) + " groups")));
  EXPECT_GT(test::largest(draw(DebugView::Approximation)), 0.5);
}

}  // namespace
}  // namespace prelight

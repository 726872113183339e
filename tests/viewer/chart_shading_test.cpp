// Pictures with light maps, compared with closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "basis/sh.h"
#include "viewer/core/chart_atlas.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using namespace test;

constexpr int order = 3;
constexpr std::size_t columns = order * order;

/// A quad whose square [-1, 1]^2 fills the middle of the picture; u = 0 is on its left, v = 0 at its top.
QuadScene mappedQuad(int width, int height, const std::vector<float>& openness) {
  QuadScene quad;
  quad.add(lambertian({0.5f, 0.5f, 0.5f}));
  quad.lookFrom({0, 0, 3}, {0, 0, 0});
  quad.setSky(halvedSky());
  quad.compile();
  quad.bakeOpen(order, 1, 1.0f, 0.0);
  ChartTransfer::Map map{0, width, height, {}, {}};
  for (const glm::vec3& p : quad.compiled.positions)
    map.coords.emplace_back(0.5f * (p.x + 1.0f), 0.5f * (1.0f - p.y));
  std::vector<double> open(columns);
  sh::openTransfer({0, 0, 1}, order, open);
  for (const float o : openness)
    for (const double value : open) map.coefficients.push_back(o * static_cast<float>(value));
  quad.bake.chartTransfer = ChartTransfer{order, 1, 0, {map}};
  return quad;
}

/// The middle of a picture of an open quad under the same sky, with transfer at vertices.
glm::vec3 openPixel() {
  QuadScene quad = mappedQuad(1, 1, {1.0f});
  quad.bake.chartTransfer.reset();
  quad.bakeOpen(order);
  return pixelAt(quad.render(square(viewer::Shading::Sh)));
}

void expectFactor(const glm::vec3& pixel, const glm::vec3& open, float factor) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], factor * open[c], 2e-3f) << c;
}

TEST(ChartShading, EvenMap_IsLitLikeVertices) {
  const QuadScene quad = mappedQuad(4, 4, std::vector<float>(16, 1.0f));
  const glm::vec3 open = openPixel();
  EXPECT_GT(open.b, 0.1f);
  expectFactor(pixelAt(quad.render(square(viewer::Shading::Sh))), open, 1.0f);
}

// Two texels side by side: left and right of their centres the picture shows their values, and the mean in
// the middle.
TEST(ChartShading, Texels_LieWhereTheCoordinatesSay) {
  const QuadScene quad = mappedQuad(2, 1, {0.2f, 0.8f});
  const Picture picture = quad.render(square(viewer::Shading::Sh, 65));
  const glm::vec3 open = openPixel();
  expectFactor(pixelAt(picture, 0.5, 0.5), open, 0.5f);
  // A field of view of 45 degrees at 3 m shows 2.49 m: u = 1/8 is 0.75 m left of the middle.
  const double across = 2.0 * 3.0 * std::tan(0.5 * 0.785398);
  expectFactor(pixelAt(picture, 0.5 - 0.75 / across, 0.5), open, 0.2f);
  expectFactor(pixelAt(picture, 0.5 + 0.75 / across, 0.5), open, 0.8f);
}

TEST(ChartShading, Rows_RunFromTheTop) {
  const QuadScene quad = mappedQuad(1, 2, {0.9f, 0.1f});
  const Picture picture = quad.render(square(viewer::Shading::Sh, 65));
  const double across = 2.0 * 3.0 * std::tan(0.5 * 0.785398);
  expectFactor(pixelAt(picture, 0.5, 0.5 - 0.75 / across), openPixel(), 0.9f);
  expectFactor(pixelAt(picture, 0.5, 0.5 + 0.75 / across), openPixel(), 0.1f);
}

TEST(ChartShading, NegativeSeries_AreDarkNotNegative) {
  const QuadScene quad = mappedQuad(1, 1, {-1.0f});
  const Picture picture = quad.render(square(viewer::Shading::Sh));
  EXPECT_EQ(pixelAt(picture), glm::vec3(0.0f));
}

TEST(ChartShading, PrimitiveWithoutAMap_KeepsItsVertices) {
  QuadScene quad = mappedQuad(1, 1, {0.0f});
  quad.bake.chartTransfer->maps.clear();
  quad.bakeOpen(order);
  expectFactor(pixelAt(quad.render(square(viewer::Shading::Sh))), openPixel(), 1.0f);
}

TEST(ChartAtlas, Rectangles_FitWithoutOverlap) {
  std::vector<glm::ivec2> sizes;
  for (int i = 0; i < 60; ++i) sizes.emplace_back(10 + 7 * i % 90, 5 + 13 * i % 110);
  const viewer::ChartAtlas atlas = viewer::packCharts(sizes, 128);
  EXPECT_EQ(atlas.side, 128);
  EXPECT_GT(atlas.layers, 1);
  for (std::size_t a = 0; a < sizes.size(); ++a) {
    const auto& p = atlas.places[a];
    EXPECT_TRUE(p.x >= 0 && p.y >= 0 && p.x + sizes[a].x <= 128 && p.y + sizes[a].y <= 128);
    EXPECT_LT(p.layer, atlas.layers);
    for (std::size_t b = a + 1; b < sizes.size(); ++b) {
      const auto& q = atlas.places[b];
      const bool apart = p.layer != q.layer || p.x + sizes[a].x <= q.x || q.x + sizes[b].x <= p.x ||
                         p.y + sizes[a].y <= q.y || q.y + sizes[b].y <= p.y;
      EXPECT_TRUE(apart) << a << " " << b;
    }
  }
}

TEST(ChartAtlas, LargeRectangle_WidensTheLayers) {
  EXPECT_EQ(viewer::packCharts({{300, 20}, {10, 10}}, 128).side, 300);
  EXPECT_EQ(viewer::packCharts({}, 128).layers, 0);
}

}  // namespace
}  // namespace prelight

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "basis/quadrature.h"
#include "basis/sh.h"
#include "benchmarks/lab/made_materials.h"
#include "prelight/error.h"
#include "scene/surface/tangent_space.h"
#include "support/run_bake.h"
#include "support/scenes.h"
#include "techniques/chart_transfer/chart_caster.h"

namespace prelight {
namespace {

using std::numbers::pi;
constexpr int order = 4;
constexpr std::size_t columns = order * order;

/// A chart of a ground's square: u along +X, v along +Z.
Chart chartOfGround(const CompiledScene& scene, std::size_t primitive, float half, int size) {
  Chart chart{primitive, 0, size, size, {}, {}};
  const PrimitiveRange& range = scene.primitives[primitive];
  for (std::uint32_t v = 0; v < range.vertexCount; ++v) {
    const glm::vec3 p = scene.positions[range.firstVertex + v];
    chart.coords.emplace_back(0.5f + 0.5f * p.x / half, 0.5f + 0.5f * p.z / half);
  }
  return chart;
}

ChartTransfer castFrom(const CompiledScene& scene, const Charts& charts, std::uint32_t rays,
                       std::uint64_t seed = 0) {
  Tracer tracer(scene, test::sharedDevice());
  Progress progress;
  ChartTransferReport report;
  ChartTransferOptions options;
  options.order = order;
  options.rays = rays;
  options.seed = seed;
  return makeChartTransfer(scene, charts, makeFitMesh(scene), tracer, SlotTransfer{}, options, progress,
                           report);
}

std::vector<double> meanOf(const ChartTransfer::Map& map) {
  std::vector<double> mean(columns, 0.0);
  const double texels = static_cast<double>(map.coefficients.size() / columns);
  for (std::size_t i = 0; i < map.coefficients.size(); ++i) mean[i % columns] += map.coefficients[i] / texels;
  return mean;
}

double largestDifference(const ChartTransfer::Map& map, std::span<const double> expected) {
  double most = 0.0;
  for (std::size_t i = 0; i < map.coefficients.size(); ++i)
    most = std::max(most, std::abs(map.coefficients[i] - expected[i % columns]));
  return most;
}

/// Light on a texel under a uniform sky of radiance 1, divided by pi.
double openness(const ChartTransfer::Map& map, std::size_t texel) {
  return map.coefficients[texel * columns] * std::sqrt(4.0 * pi);
}

/// (1/pi) times the integral over the upper half of max(n.w, 0) Y_i(w), by midpoints.
std::vector<double> tiltedTransfer(const glm::dvec3& n) {
  constexpr int rows = 400, steps = 800;
  std::vector<double> sum(columns, 0.0), basis(columns);
  for (int r = 0; r < rows; ++r)
    for (int s = 0; s < steps; ++s) {
      const double y = (r + 0.5) / rows, angle = 2.0 * pi * (s + 0.5) / steps;
      const double radius = std::sqrt(1.0 - y * y);
      const glm::dvec3 w(radius * std::cos(angle), y, radius * std::sin(angle));
      sh::evaluate(w, order, basis);
      const double weight = std::max(glm::dot(n, w), 0.0) / pi * 2.0 * pi / (rows * steps);
      for (std::size_t i = 0; i < columns; ++i) sum[i] += weight * basis[i];
    }
  return sum;
}

TEST(ChartBake, OpenPlane_IsExactInEveryTexel) {
  const CompiledScene scene = test::ground(2, 1.0f);
  const ChartTransfer transfer = castFrom(scene, {{chartOfGround(scene, 0, 1.0f, 8)}, {}, {}}, 64);
  ASSERT_EQ(transfer.maps.size(), 1u);
  ASSERT_EQ(transfer.maps[0].coefficients.size(), 64 * columns);
  std::vector<double> open(columns);
  sh::openTransfer({0, 1, 0}, order, open);
  EXPECT_LT(largestDifference(transfer.maps[0], open), 1e-6);
}

// The surface itself hides the sky from a tilted normal: rays that go below it end there.
TEST(ChartBake, TiltedNormals_MatchQuadratureOverTheOpenHalf) {
  CompiledScene scene = test::ground(1, 5000.0f);
  Chart chart = chartOfGround(scene, 0, 5000.0f, 16);
  scene.texCoords = chart.coords;
  scene.materials[0].normalTexture.image = 0;
  const glm::ivec3 stored(210, 100, 218);
  Image image{"tilt", 1, 1, {210, 100, 218, 255}};
  chart.normalImage = 0;
  const ChartTransfer transfer = castFrom(scene, {{chart}, {image}, {}, cornerTangents(scene)}, 1024);
  const glm::dvec3 t = glm::normalize(glm::dvec3(stored) / 127.5 - 1.0);
  // u runs along +X and v along +Z; the opposite of v is the normal map's up.
  const std::vector<double> expected = tiltedTransfer({t.x, t.z, -t.y});
  const std::vector<double> mean = meanOf(transfer.maps[0]);
  for (std::size_t i = 0; i < columns; ++i) EXPECT_NEAR(mean[i], expected[i], 3e-4) << i;
  EXPECT_LT(largestDifference(transfer.maps[0], expected), 6e-3);
}

// A ball above the plane hides (r / d)^2 cos of an even sky (Howell's catalogue, B-38 for a whole ball).
TEST(ChartBake, BallAbovePlane_HidesItsFormFactor) {
  constexpr float radius = 0.5f, height = 1.2f, half = 2.0f;
  CompiledScene scene = test::ground(4, half);
  test::append(scene, test::sphere(96, radius, {0, height, 0}));
  const ChartTransfer transfer = castFrom(scene, {{chartOfGround(scene, 0, half, 16)}, {}, {}}, 1024);
  double worst = 0.0, squares = 0.0;
  for (std::size_t texel = 0; texel < 256; ++texel) {
    const double x = half * ((static_cast<double>(texel % 16) + 0.5) / 8.0 - 1.0),
                 z = half * ((static_cast<double>(texel / 16) + 0.5) / 8.0 - 1.0);
    const double d2 = x * x + z * z + height * height;
    const double difference =
        openness(transfer.maps[0], texel) - (1.0 - radius * radius / d2 * height / std::sqrt(d2));
    worst = std::max(worst, std::abs(difference));
    squares += difference * difference;
  }
  EXPECT_LT(std::sqrt(squares / 256), 0.004);
  EXPECT_LT(worst, 0.015);
}

// Vertices and texels see the same light in different ways: as a fit and as a mean.
TEST(ChartBake, SmoothSurface_AgreesWithTheVertices) {
  constexpr float half = 2.0f;
  CompiledScene scene = test::ground(16, half);
  test::append(scene, test::sphere(24, 0.5f, {0, 1.0f, 0}));
  scene.materials[0].albedo = {0.8f, 0.6f, 0.3f};
  scene.materials[1].albedo = {0.2f, 0.5f, 0.9f};
  BakeRequest request;
  request.sh.order = order;
  request.chartTransfer.size = 33;
  request.bounces = 2;
  request.effort.rays = 1024;
  Chart chart = chartOfGround(scene, 0, half, 33);
  // Places texel centres on vertices: 33 texels cover 16 quads and half a texel around them.
  for (glm::vec2& uv : chart.coords) uv = (uv * 32.0f + 0.5f) / 33.0f;
  const Charts charts{{chart}, {}, {}};
  const test::BakeResult result = test::runBake(scene, request, charts);
  ASSERT_TRUE(result.bake.chartTransfer);
  const ChartTransfer& texels = *result.bake.chartTransfer;
  EXPECT_EQ(texels.channels, 3);
  double squares = 0.0, worst = 0.0, brightest = 0.0;
  for (std::uint32_t v = 0; v < 17 * 17; ++v) {
    const glm::ivec2 at(glm::round(chart.coords[v] * 33.0f - 0.5f));
    for (std::size_t k = 0; k < 3 * columns; ++k) {
      const double vertex = result.bake.sh->coefficients[v * 3 * columns + k];
      const double texel =
          texels.maps[0].coefficients[static_cast<std::size_t>(at.y * 33 + at.x) * 3 * columns + k];
      squares += (vertex - texel) * (vertex - texel);
      worst = std::max(worst, std::abs(vertex - texel));
      brightest = std::max(brightest, std::abs(vertex));
    }
  }
  EXPECT_GT(brightest, 0.25);
  EXPECT_LT(std::sqrt(squares / (17 * 17 * 3 * columns)), 0.004);
  EXPECT_LT(worst, 0.04);
}

/// A ground, and a block that reaches into it over x < 0.1.
CompiledScene groundAndBlock() {
  CompiledScene scene = test::ground(2, 1.0f);
  test::append(scene, test::box(2, {-3.0f, -0.5f, -3.0f}, {0.1f, 0.5f, 3.0f}, false));
  return scene;
}

// The block covers half of the texels at x = 0 .. 0.2. Their uncovered halves are as bright as the ground
// beside them.
TEST(ChartBake, PlacesInsideObjects_DoNotDarkenThoseBeside) {
  const CompiledScene scene = groundAndBlock();
  const ChartTransfer coarse = castFrom(scene, {{chartOfGround(scene, 0, 1.0f, 10)}, {}, {}}, 1024);
  const ChartTransfer fine = castFrom(scene, {{chartOfGround(scene, 0, 1.0f, 80)}, {}, {}}, 1024);
  // Texel 5 of the coarse map spans x = 0 .. 0.2, of which 0.1 .. 0.2 is outside the block: texels 44 .. 47
  // of the fine map.
  double outside = 0.0;
  for (std::size_t column = 44; column < 48; ++column)
    for (std::size_t row = 40; row < 48; ++row) outside += openness(fine.maps[0], row * 80 + column) / 32.0;
  EXPECT_GT(outside, 0.2);
  EXPECT_NEAR(openness(coarse.maps[0], 5 * 10 + 5), outside, 0.02);
  // Completely hidden texels take the value of the nearest visible one.
  EXPECT_NEAR(openness(coarse.maps[0], 5 * 10 + 2), outside, 0.05);
}

TEST(ChartBake, TwoSidedObjects_HideNothingFromTheBake) {
  CompiledScene scene = groundAndBlock();
  scene.materials[1].doubleSided = true;
  const ChartTransfer transfer = castFrom(scene, {{chartOfGround(scene, 0, 1.0f, 10)}, {}, {}}, 64);
  EXPECT_EQ(openness(transfer.maps[0], 5 * 10 + 2), 0.0);
}

TEST(ChartBake, SameSeed_SameValues_OtherSeed_Others) {
  const CompiledScene scene = groundAndBlock();
  const Charts charts{{chartOfGround(scene, 0, 1.0f, 12)}, {}, {}};
  const auto first = castFrom(scene, charts, 64, 7), again = castFrom(scene, charts, 64, 7),
             other = castFrom(scene, charts, 64, 8);
  EXPECT_EQ(first.maps[0].coefficients, again.maps[0].coefficients);
  EXPECT_NE(first.maps[0].coefficients, other.maps[0].coefficients);
}

TEST(ChartBake, ShadowSets_HoldForTexels) {
  const CompiledScene scene = groundAndBlock();
  BakeRequest request;
  request.sh.order = order;
  request.chartTransfer.size = 10;
  request.effort.rays = 64;
  request.shadowSets = {{{"node 0"}, {}}};
  const Charts charts{{chartOfGround(scene, 0, 1.0f, 10)}, {}, {}};
  const test::BakeResult result = test::runBake(scene, request, charts);
  std::vector<double> open(columns);
  sh::openTransfer({0, 1, 0}, order, open);
  EXPECT_LT(largestDifference(result.bake.chartTransfer->maps[0], open), 1e-6);
}

TEST(ChartBake, MoreThanTheMemory_IsRefused) {
  const CompiledScene scene = test::ground(2, 1.0f);
  BakeRequest request;
  request.sh.order = order;
  request.chartTransfer.size = 1024;
  request.maxMemory = 1u << 20;
  EXPECT_THROW(test::runBake(scene, request, {{chartOfGround(scene, 0, 1.0f, 1024)}, {}, {}}), UsageError);
  request.sh.order = 0;
  request.ao = true;
  EXPECT_THROW(test::runBake(scene, request, {{chartOfGround(scene, 0, 1.0f, 8)}, {}, {}}), UsageError);
}

/// A ground with three grooves along Z, given by a normal texture alone.
struct Grooved {
  static constexpr int texels = grooves::texels;

  CompiledScene scene = test::ground(4, 1.0f);
  Charts charts;

  Grooved() {
    for (std::size_t v = 0; v < scene.positions.size(); ++v)
      scene.texCoords[v] = {0.5f + 0.5f * scene.positions[v].x, 0.5f + 0.5f * scene.positions[v].z};
    scene.materials[0].normalTexture.image = 0;
    charts.charts.push_back(chartOfGround(scene, 0, 1.0f, texels));
    charts.charts.back().normalImage = 0;
    charts.normalImages.push_back(grooves::normals());
    charts.tangents.assign(3 * scene.triangles.size(), glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));
  }

  std::vector<double> opennessByColumn(bool relief) const {
    Tracer tracer(scene, test::sharedDevice());
    Progress progress;
    ChartTransferReport report;
    ChartTransferOptions options;
    options.order = order;
    options.rays = 256;
    options.relief = relief;
    const ChartTransfer transfer = makeChartTransfer(scene, charts, makeFitMesh(scene), tracer,
                                                     SlotTransfer{}, options, progress, report);
    std::vector<double> columnsOpen(texels, 0.0);
    for (std::size_t t = 0; t < std::size_t{texels} * texels; ++t)
      columnsOpen[t % texels] += openness(transfer.maps[0], t) / texels;
    return columnsOpen;
  }
};

TEST(ChartBake, BumpsOfAReliefThatShadowOneAnother_SeeWhatAGrooveSees) {
  const Grooved grooved;
  const std::vector<double> open = grooved.opennessByColumn(true), flat = grooved.opennessByColumn(false);
  double worstFlat = 0.0;
  for (const int column : {32, 36, 40, 44, 48, 52, 56, 60}) {
    // A column's centre lies between the normals of two texels.
    const double expected = grooves::openAt(column);
    EXPECT_NEAR(open[static_cast<std::size_t>(column)], expected, 0.04) << column;
    worstFlat = std::max(worstFlat, std::abs(flat[static_cast<std::size_t>(column)] - expected));
  }
  EXPECT_GT(worstFlat, 0.2);
}

}  // namespace
}  // namespace prelight

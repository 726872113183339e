#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "basis/sh.h"
#include "prelight/error.h"
#include "support/devices.h"
#include "support/scenes.h"
#include "techniques/volume/volume_caster.h"
#include "techniques/volume/volume_light.h"

namespace prelight {
namespace {

constexpr int volumeOrder = 4;
constexpr double sphere4Pi = 4.0 * std::numbers::pi;

VolumeTransfer castFrom(const CompiledScene& scene, const VolumeGrid& grid, VolumeOptions options) {
  Tracer tracer(scene, test::sharedDevice());
  Progress progress;
  options.order = volumeOrder;
  return makeVolume(scene, makeFitMesh(scene), tracer, SlotTransfer{}, grid, options, progress);
}

/// (1/(4 pi)) times the integral of Y_i over the cap of half angle `angle` around `axis`.
std::vector<double> capTransfer(double angle, const glm::dvec3& axis) {
  std::vector<double> zonal(volumeOrder), values(volumeOrder * volumeOrder);
  sh::capZonal(angle, zonal);
  sh::turnZonal(zonal, axis, values);
  for (double& v : values) v /= sphere4Pi;
  return values;
}

double maxDifference(const VolumeTransfer& volume, std::size_t voxel, std::span<const double> expected) {
  double most = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    most = std::max(most, std::abs(double(volume.coefficients[voxel * expected.size() + i]) - expected[i]));
  return most;
}

glm::dvec3 centreOf(const VolumeGrid& grid, std::size_t voxel) {
  const auto i = static_cast<int>(voxel);
  const glm::ivec3 cell(i % grid.size.x, i / grid.size.x % grid.size.y, i / (grid.size.x * grid.size.y));
  return grid.min + grid.cell() * (glm::dvec3(cell) + 0.5);
}

TEST(VolumeGrid, Cells_AreCubesAroundTheScene) {
  CompiledScene scene = test::box(2, {-1, 0, -2}, {1, 0.1f, 2}, false);
  scene.origin = {100.0, 0.0, 0.0};
  const VolumeGrid grid = makeVolumeGrid(scene, 16);
  EXPECT_EQ(grid.size, glm::ivec3(8, 2, 16));
  EXPECT_NEAR(grid.cell(), 0.25, 1e-9);
  EXPECT_NEAR(grid.min.x, 99.0, 1e-6);
  EXPECT_NEAR(0.5 * (grid.min.y + grid.max.y), 0.05, 1e-6);
  EXPECT_EQ(makeVolumeGrid(scene, 1).size, glm::ivec3(1));
}

TEST(Volume, OpenVoxel_IsExact) {
  const CompiledScene scene = test::ground(2, 1.0f);
  VolumeOptions options;
  options.limits.farthest = 1e-3;
  const VolumeGrid grid{{2, 2, 2}, {-1, 0.5, -1}, {1, 2.5, 1}};
  const VolumeTransfer volume = castFrom(scene, grid, options);
  for (std::size_t v = 0; v < 8; ++v) {
    EXPECT_NEAR(volume.coefficients[v * 16], 1.0 / std::sqrt(sphere4Pi), 1e-7);
    for (std::size_t i = 1; i < 16; ++i) EXPECT_EQ(volume.coefficients[v * 16 + i], 0.0f);
    EXPECT_EQ(volume.air[v], 1);
  }
}

// The plane ends 5000 m away: 2e-4 of its half of the sphere is missing.
TEST(Volume, VoxelAbovePlane_SeesTheUpperHemisphere) {
  const CompiledScene scene = test::ground(1, 5000.0f);
  VolumeOptions options;
  options.rays = 4096;
  const VolumeTransfer volume = castFrom(scene, {{2, 2, 2}, {-1, 0.1, -1}, {1, 2.1, 1}}, options);
  const std::vector<double> expected = capTransfer(0.5 * std::numbers::pi, {0, 1, 0});
  for (std::size_t v = 0; v < 8; ++v) EXPECT_LT(maxDifference(volume, v, expected), 1.5e-3) << v;
}

TEST(Volume, VoxelBesideSphere_LosesItsCap) {
  const CompiledScene scene = test::sphere(96, 1.0f, {0, 0, 0});
  VolumeOptions options;
  options.rays = 4096;
  const VolumeGrid grid{{3, 2, 2}, {1.2, 0.3, -0.5}, {2.7, 1.3, 0.5}};
  const VolumeTransfer volume = castFrom(scene, grid, options);
  for (std::size_t v = 0; v < grid.count(); ++v) {
    const glm::dvec3 p = centreOf(grid, v);
    std::vector<double> expected = capTransfer(std::asin(1.0 / glm::length(p)), -glm::normalize(p));
    for (double& e : expected) e = -e;
    expected[0] += 1.0 / std::sqrt(sphere4Pi);
    EXPECT_LT(maxDifference(volume, v, expected), 1.5e-3) << v;
  }
}

TEST(Volume, VoxelInsideSolid_IsDarkAndNotAir) {
  const CompiledScene scene = test::box(2, {-1, -1, -1}, {1, 1, 1}, false);
  const VolumeTransfer volume = castFrom(scene, {{3, 1, 1}, {-0.9, -0.5, -0.5}, {2.1, 0.5, 0.5}}, {});
  EXPECT_EQ(volume.air, (std::vector<std::uint8_t>{0, 0, 1}));
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(volume.coefficients[i], 0.0f);
  // Beside the object, cells inside it do not darken the air.
  const VolumeSample sample = sampleVolume(volume, {1.2, 0.0, 0.0});
  EXPECT_NEAR(sample.coefficients[1][0], volume.coefficients[32], 1e-7);

  CompiledScene leaves = scene;
  leaves.materials[0].doubleSided = true;
  EXPECT_EQ(castFrom(leaves, volume.grid, {}).air[0], 1);
}

// Above an endless plane of albedo a under an open sky, half of all directions show a times the plane's
// transfer.
TEST(Volume, BounceOffPlane_IsHalfItsExitance) {
  CompiledScene scene = test::ground(2, 5000.0f);
  scene.materials[0].albedo = {0.8f, 0.4f, 0.0f};
  BakeRequest request;
  request.sh.order = volumeOrder;
  request.bounces = 1;
  request.effort.rays = 1024;
  request.volume.size = 2;
  BakeReport report;
  Progress progress;
  const Bake bake =
      bakeScene(scene, request, makePlan(Scene(), scene, request), test::sharedDevice(), progress, report);
  // The cells would be 5 km wide, so that measurements use a grid of their own.
  ASSERT_TRUE(bake.volume);
  EXPECT_EQ(bake.volume->grid.size, glm::ivec3(2));
  SlotTransfer surface{volumeOrder, 0, {}, {}, {}, 1};
  std::array<double, volumeOrder * volumeOrder> open{};
  sh::openTransfer({0, 1, 0}, volumeOrder, open);
  const FitMesh mesh = makeFitMesh(scene);
  for (std::uint32_t s = 0; s < mesh.slotCount() * 3; ++s)
    surface.reflected.insert(surface.reflected.end(), open.begin(), open.end());
  Tracer tracer(scene, test::sharedDevice());
  VolumeOptions options{volumeOrder, 1, false, 4096, 3, {}};
  const VolumeTransfer volume =
      makeVolume(scene, mesh, tracer, surface, {{1, 1, 1}, {-1, 0.1, -1}, {1, 2.1, 1}}, options, progress);
  ASSERT_EQ(volume.channels, 3);
  const std::vector<double> sky = capTransfer(0.5 * std::numbers::pi, {0, 1, 0});
  const std::array<double, 3> albedo{0.8, 0.4, 0.0};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < open.size(); ++i)
      EXPECT_NEAR(volume.coefficients[c * 16 + i], sky[i] + 0.5 * albedo[c] * open[i], 2e-3) << c << ' ' << i;
  for (std::size_t i = 0; i < open.size(); ++i) EXPECT_NEAR(volume.direct[i], sky[i], 1.5e-3);
}

VolumeTransfer gradient() {
  VolumeTransfer volume{{{4, 3, 2}, {0, 0, 0}, {4, 3, 2}}, 1, 1, 0, {}, {}, std::vector<std::uint8_t>(24, 1)};
  for (std::size_t v = 0; v < 24; ++v) {
    const glm::dvec3 p = centreOf(volume.grid, v);
    volume.coefficients.push_back(static_cast<float>(1.0 + p.x + 2.0 * p.y - 3.0 * p.z));
  }
  return volume;
}

TEST(SampleVolume, LinearField_IsReproduced) {
  const VolumeTransfer volume = gradient();
  const auto at = [&](double x, double y, double z) { return sampleVolume(volume, {x, y, z}).direct[0]; };
  EXPECT_NEAR(at(1.7, 2.2, 0.9), 1.0 + 1.7 + 4.4 - 2.7, 1e-6);
  EXPECT_NEAR(at(3.5, 0.5, 1.5), 1.0 + 3.5 + 1.0 - 4.5, 1e-6);
  EXPECT_NEAR(at(-7.0, 0.5, 0.5), 1.0 + 0.5 + 1.0 - 1.5, 1e-6) << "constant beyond the outermost centres";
  EXPECT_NEAR(at(99.0, 99.0, 99.0), 1.0 + 3.5 + 5.0 - 4.5, 1e-6);
}

TEST(MovingPoint, InTheOpen_GetsTheLightsIrradiance) {
  VolumeSample sample;
  sample.order = volumeOrder;
  sample.direct.assign(volumeOrder * volumeOrder, 0.0);
  sample.direct[0] = 1.0 / std::sqrt(sphere4Pi);
  sample.coefficients.fill(sample.direct);
  const sh::ShProduct product(volumeOrder, volumeOrder);
  std::vector<double> light(3 * volumeOrder * volumeOrder), cosine(volumeOrder * volumeOrder);
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = std::sin(1.0 + double(i));
  const glm::dvec3 normal = glm::normalize(glm::dvec3(1, 2, -0.5));
  sh::openTransfer(normal, volumeOrder, cosine);
  const glm::dvec3 radiance = diffuseRadiance(sample, product, light, normal);
  for (std::size_t c = 0; c < 3; ++c) {
    double expected = 0.0;
    for (std::size_t i = 0; i < cosine.size(); ++i) expected += light[c * 16 + i] * cosine[i];
    EXPECT_NEAR(radiance[static_cast<int>(c)], expected, 1e-12);
  }
}

// White sky and black floor: facing up gives 1. Facing down gives 0, except for the edge that four bands
// cannot resolve.
TEST(MovingPoint, AboveBlackFloor_IsLitFromAbove) {
  VolumeSample sample;
  sample.order = volumeOrder;
  sample.direct = capTransfer(0.5 * std::numbers::pi, {0, 1, 0});
  sample.coefficients.fill(sample.direct);
  const sh::ShProduct product(volumeOrder, volumeOrder);
  std::vector<double> light(3 * volumeOrder * volumeOrder, 0.0);
  for (std::size_t c = 0; c < 3; ++c) light[c * 16] = std::sqrt(sphere4Pi);
  EXPECT_NEAR(diffuseRadiance(sample, product, light, {0, 1, 0}).x, 1.0, 0.02);
  EXPECT_NEAR(diffuseRadiance(sample, product, light, {0, -1, 0}).x, 0.0, 0.02);
  EXPECT_NEAR(diffuseRadiance(sample, product, light, {1, 0, 0}).x, 0.5, 0.02);
  EXPECT_NEAR(meanRadiance(sample, light, 16).x, 0.5, 1e-12);
}

TEST(Volume, WithoutSh_IsRefused) {
  const CompiledScene scene = test::ground(2, 1.0f);
  BakeRequest request;
  request.ao = true;
  request.volume.size = 4;
  BakeReport report;
  Progress progress;
  EXPECT_THROW(
      bakeScene(scene, request, makePlan(Scene(), scene, request), test::sharedDevice(), progress, report),
      UsageError);
}

}  // namespace
}  // namespace prelight

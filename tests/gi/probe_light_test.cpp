#include "gi/probes/probe_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/directions.h"
#include "basis/sh_evaluate.h"
#include "support/devices.h"
#include "support/materials.h"
#include "support/scenes.h"
#include "techniques/volume/volume_light.h"

namespace prelight::test {
namespace {

Light pointLight(const glm::dvec3& position, float intensity) {
  Light light;
  light.position = position;
  light.intensity = glm::vec3(intensity);
  return light;
}

/// Probes in a scene whose whole surface has one irradiance.
IrradianceVolume probesOf(const CompiledScene& scene, const std::vector<Light>& lights, float irradiance,
                          int size, ProbeReport& report) {
  LightMapLayout layout;
  layout.width = layout.height = 1;
  layout.corners.assign(6 * std::size_t{scene.triangleCount()}, glm::vec2(0.5f));
  layout.chartOf.assign(2 * std::size_t{scene.triangleCount()}, 0);
  ProbeRequest request;
  request.size = size;
  Progress progress;
  return gatherProbes({scene, noImages(), lights}, layout, std::vector<glm::vec3>(1, glm::vec3(irradiance)),
                      request, sharedDevice(), progress, report);
}

CompiledScene room(const glm::vec3& lower, const glm::vec3& upper, float albedo) {
  CompiledScene scene = box(1, lower, upper, true);
  scene.materials[0] = lambert(albedo);
  return scene;
}

TEST(ProbeLight, EvenlyLitRoom_GivesEveryNormalAlbedoTimesIrradiance) {
  ProbeReport report;
  const IrradianceVolume volume =
      probesOf(room(glm::vec3(-1.0f), glm::vec3(1.0f), 0.5f), {}, 3.0f, 3, report);
  ASSERT_EQ(volume.grid.count(), 27u);
  for (const glm::dvec3& n : {glm::dvec3(0, 1, 0), glm::dvec3(0.6, 0, -0.8), glm::dvec3(-1, 0, 0)}) {
    for (std::size_t probe = 0; probe < 27; ++probe)
      EXPECT_NEAR(probeIrradiance(volume, probe, n).y, 1.5, 1e-4);
    EXPECT_NEAR(irradianceAt(volume, {0.3, -0.2, 0.7}, n).y, 1.5, 1e-4);
  }
  EXPECT_EQ(report.placement.inside, 0u);
}

TEST(ProbeLight, PointLight_HasTheHarmonicsOfItsDirection) {
  const glm::dvec3 lamp(0.3, 0.8, -0.1);
  ProbeReport report;
  const IrradianceVolume volume =
      probesOf(room(glm::vec3(-1.0f), glm::vec3(1.0f), 0.0f), {pointLight(lamp, 2.0f)}, 0.0f, 4, report);
  for (std::size_t probe = 0; probe < volume.grid.count(); ++probe) {
    const glm::dvec3 way = lamp - voxelCentre(volume.grid, probe);
    const double arriving = 2.0 / glm::dot(way, way);
    std::array<double, 9> expected{};
    sh::evaluate(glm::normalize(way), 3, expected);
    for (std::size_t i = 0; i < 9; ++i)
      EXPECT_NEAR(volume.coefficients[3 * (9 * probe + i)], arriving * expected[i], 0.03 * arriving);
  }
}

TEST(ProbeLight, InASolid_ProbesMoveOutOrAreNotValid) {
  CompiledScene scene = room(glm::vec3(-1.0f), glm::vec3(1.0f), 0.0f);
  append(scene, box(1, glm::vec3(-0.7f), glm::vec3(0.7f), false));
  scene.triangleFlat.assign(scene.triangles.size(), 1);
  ProbeReport report;
  const IrradianceVolume volume = probesOf(scene, {}, 0.0f, 8, report);
  std::size_t invalid = 0;
  for (std::size_t probe = 0; probe < volume.grid.count(); ++probe) {
    const auto depth = [](const glm::dvec3& p) {
      return 0.7 - std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    };
    const double inGrid = depth(voxelCentre(volume.grid, probe));
    if (volume.valid[probe] != 0)
      EXPECT_LT(depth(glm::dvec3(volume.places[probe])), 0.0) << "a valid probe looks from the air";
    else
      EXPECT_GT(inGrid, 0.125) << "it is deeper than half a cell";
    invalid += volume.valid[probe] == 0;
  }
  EXPECT_EQ(invalid, 64u) << "4 x 4 x 4 lie 0.2 m deep and more";
  EXPECT_EQ(report.placement.inside, 64u);
  EXPECT_EQ(report.placement.moved, 216u - 64u);
}

/// A lit and a dark room on the two sides of an infinitely thin wall at x = 0.
TEST(ProbeLight, BehindAWall_NoLightComesThrough) {
  CompiledScene scene = room({-1.0f, -1.0f, -1.0f}, {0.0f, 1.0f, 1.0f}, 0.0f);
  append(scene, box(1, {0.0f, -1.0f, -1.0f}, {1.0f, 1.0f, 1.0f}, true));
  scene.triangleFlat.assign(scene.triangles.size(), 1);
  scene.materials[1] = lambert(0.0f);
  ProbeReport report;
  IrradianceVolume volume = probesOf(scene, {pointLight({-0.5, 0.1, 0.2}, 1.0f)}, 0.0f, 8, report);
  const glm::dvec3 towards(-1.0, 0.0, 0.0), away(1.0, 0.0, 0.0);
  const auto most = [&] {
    double largest = 0.0;
    for (const double x : {0.01, 0.05, 0.1, 0.15})
      for (double y = -0.9; y < 1.0; y += 0.2)
        for (double z = -0.9; z < 1.0; z += 0.2)
          largest = std::max(largest, irradianceAt(volume, {x, y, z}, towards).y);
    return largest;
  };
  const double lit =
      irradianceAt(volume, {-0.1, 0.1, 0.2}, towards).y + irradianceAt(volume, {-0.1, 0.1, 0.2}, away).y;
  EXPECT_GT(lit, 1.0);
  EXPECT_LT(most(), 1e-6 * lit);
  volume.surfaces.assign(volume.surfaces.size(), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
  EXPECT_GT(most(), 0.1 * lit) << "without surfaces it would";
}

TEST(OctahedralMap, Directions_ComeBack) {
  for (int i = 0; i < 200; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / 200.0, r = std::sqrt(1.0 - z * z);
    const glm::dvec3 d(r * std::cos(2.4 * i), r * std::sin(2.4 * i), z);
    EXPECT_NEAR(glm::distance(octahedralDirection(octahedralPlace(d)), d), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace prelight::test

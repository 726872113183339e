#include "photon/importons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "support/devices.h"
#include "support/materials.h"
#include "support/scenes.h"

namespace prelight::test {
namespace {

using std::numbers::pi;

Light lampAt(const glm::dvec3& position, float intensity) {
  Light light;
  light.type = LightType::Point;
  light.position = position;
  light.intensity = glm::vec3(intensity);
  return light;
}

CameraAxes eyeAt(const glm::dvec3& position, const glm::dvec3& target, double halfHeight) {
  CameraAxes axes;
  axes.eye = position;
  axes.forward = glm::normalize(target - position);
  axes.right = halfHeight * glm::normalize(glm::cross(axes.forward, glm::dvec3(0, 1, 0)));
  axes.up = glm::cross(axes.right, axes.forward);
  return axes;
}

PhotonRequest photonsOf(PhotonKind kind, std::uint64_t photons) {
  PhotonRequest request;
  request.kind = kind;
  request.photons = photons;
  return request;
}

struct Sent {
  SentPhotons byPower, byImportance;
};

Sent send(const CompiledScene& scene, const std::vector<Light>& lights, const CameraAxes& eye,
          const PhotonRequest& request, const Environment* sky = nullptr) {
  TransportScene transport({scene, noImages(), lights, sky}, sharedDevice());
  Progress progress;
  return {sendPhotons(scene, transport, request, progress),
          sendByImportance(scene, transport, eye, request, progress)};
}

/// Power that landed within a distance of the middle of the floor, and the variance that it would have if
/// photons were independent.
struct Landed {
  double power = 0.0, variance = 0.0;
  std::size_t count = 0;
};

Landed landedWithin(const SentPhotons& sent, double distance) {
  Landed landed;
  for (const device::Photon& p : sent.hits.photons) {
    const double w = double(p.power[0]);
    if (std::max(std::abs(p.position[0]), std::abs(p.position[2])) > distance) continue;
    landed.power += w;
    landed.variance += w * w;
    ++landed.count;
  }
  return landed;
}

/// A ball on a floor so large that few photons land near the ball.
CompiledScene ballOnALargeFloor() {
  CompiledScene scene = ground(1, 60.0f, 0.0f);
  scene.materials[0] = lambert(0.7f);
  append(scene, sphere(24, 1.0f, {0.0f, 1.0f, 0.0f}));
  for (CompiledMaterial& material : scene.materials) material = lambert(0.7f);
  scene.triangleFlat.assign(scene.triangles.size(), 1);
  return scene;
}

TEST(Importons, EachKindOfLight_BringsTheSamePowerInMorePhotonsToWhatIsSeen) {
  const CompiledScene scene = ballOnALargeFloor();
  CompiledScene lamp = scene;
  append(lamp, ground(1, 0.3f, 9.0f));
  lamp.materials.push_back(emitter(glm::vec3(50.0f)));
  lamp.materials.back().doubleSided = true;
  for (std::size_t t = lamp.triangleCount() - 2; t < lamp.triangleCount(); ++t)
    lamp.triangleMaterials[t] = static_cast<std::uint32_t>(lamp.materials.size() - 1);
  lamp.triangleFlat.assign(lamp.triangles.size(), 1);
  Light sun;
  sun.type = LightType::Directional;
  sun.direction = glm::normalize(glm::dvec3(-0.3, -1, 0.1));
  sun.intensity = glm::vec3(2.0f);
  Light spot = lampAt({20, 15, 5}, 30.0f);
  spot.type = LightType::Spot;
  spot.direction = {0, -1, 0};
  spot.outerConeAngle = 1.3f;
  const Environment sky = constantEnvironment(glm::vec3(0.5f));
  const struct {
    const char* name;
    const CompiledScene& scene;
    std::vector<Light> lights;
    const Environment* sky;
    double gain;  ///< Least gain in the number of photons.
  } cases[] = {
      {"sun", scene, {sun}, nullptr, 5.0},   {"point", scene, {lampAt({20, 10, 0}, 30.0f)}, nullptr, 3.0},
      {"spot", scene, {spot}, nullptr, 3.0}, {"emitters", lamp, {}, nullptr, 1.0},
      {"sky", scene, {}, &sky, 3.0},         {"all", lamp, {sun, spot}, &sky, 3.0}};
  const CameraAxes eye = eyeAt({5, 2, 0}, {0, 0.5, 0}, 0.4);
  for (const auto& c : cases) {
    const Sent sent = send(c.scene, c.lights, eye, photonsOf(PhotonKind::All, 1 << 16), c.sky);
    const Landed power = landedWithin(sent.byPower, 3.0), importance = landedWithin(sent.byImportance, 3.0);
    EXPECT_NEAR(importance.power, power.power, 3.5 * std::sqrt(power.variance + importance.variance))
        << c.name;
    EXPECT_GT(double(importance.count), c.gain * double(power.count)) << c.name;
  }
}

/// The power of first hits on the walls of a cube around a lamp follows solid angles in closed form, wherever
/// the eye looks.
TEST(Importons, LampInACube_LightsEachPartOfItsWallsByItsSolidAngle) {
  CompiledScene scene = box(1, glm::vec3(-1.0f), glm::vec3(1.0f), true);
  scene.materials[0] = lambert(0.5f);
  const PhotonRequest request = photonsOf(PhotonKind::All, 1 << 18);
  const Sent sent = send(scene, {lampAt({0, 0, 0}, 1.0f)}, eyeAt({0, 0, 0.9}, {0, 0, -1}, 0.1), request);
  std::vector<bool> seen(sent.byImportance.report.emitted, false);
  double quarters[4] = {}, other = 0.0;
  for (std::size_t i = 0; i < sent.byImportance.hits.photons.size(); ++i) {
    const device::Photon& p = sent.byImportance.hits.photons[i];
    if (seen[sent.byImportance.hits.paths[i]]) continue;
    seen[sent.byImportance.hits.paths[i]] = true;
    if (p.position[2] < -0.999f)
      quarters[(p.position[0] > 0.0f ? 1 : 0) + (p.position[1] > 0.0f ? 2 : 0)] += double(p.power[0]);
    else
      other += double(p.power[0]);
  }
  for (const double quarter : quarters) EXPECT_NEAR(quarter, 4.0 * pi / 24.0, 0.01 * 4.0 * pi / 24.0);
  EXPECT_NEAR(other, 5.0 * 4.0 * pi / 6.0, 0.003 * 5.0 * 4.0 * pi / 6.0);
}

TEST(Importons, ClosedRoom_KeepsItsGeometricSeriesAndBoundsWhatAPhotonCarries) {
  for (const float albedo : {0.5f, 0.8f}) {
    CompiledScene scene = box(1, glm::vec3(-1.0f), glm::vec3(1.0f), true);
    scene.materials[0] = lambert(albedo);
    const Sent sent = send(scene, {lampAt({0.5, 0.5, 0.5}, 1.0f)}, eyeAt({-0.9, 0, 0}, {-1, 0.9, 0}, 0.2),
                           photonsOf(PhotonKind::All, 1 << 17));
    const Landed landed = landedWithin(sent.byImportance, 2.0);
    const double expected = 4.0 * pi / (1.0 - double(albedo));
    // All photons of a path carry its weight, so that the error of a sum depends on the number of paths, with
    // a few photons each.
    EXPECT_NEAR(landed.power, expected, 3.5 * std::sqrt(landed.variance / (1.0 - double(albedo))));
    const double mean = 4.0 * pi / double(sent.byImportance.report.emitted);
    for (const device::Photon& p : sent.byImportance.hits.photons)
      ASSERT_LE(double(p.power[0]), 1.15 * boundOfPower * mean);  // Counts are rounded.
    const PhotonPower& power = sent.byImportance.report.power;
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(power.emitted[c], power.absorbed[c] + power.escaped[c] + power.cut[c]);
  }
}

TEST(Importons, EyeThatSeesNothing_LeavesPhotonsToPower) {
  const CompiledScene scene = ballOnALargeFloor();
  const Sent sent = send(scene, {lampAt({0, 5, 0}, 1.0f)}, eyeAt({0, 10, 0}, {0.1, 20, 0}, 0.1),
                         photonsOf(PhotonKind::All, 10000));
  ASSERT_EQ(sent.byPower.hits.photons.size(), sent.byImportance.hits.photons.size());
  EXPECT_EQ(0, std::memcmp(sent.byPower.hits.photons.data(), sent.byImportance.hits.photons.data(),
                           sent.byPower.hits.photons.size() * sizeof(device::Photon)));
}

TEST(ImportanceMap, EvenImportons_HaveTheirDensityAndEmptySpaceThatAround) {
  CompiledScene scene = ground(1, 2.0f, 0.0f);
  std::vector<LandedImporton> importons;
  for (int i = 0; i < 512; ++i)
    for (int k = 0; k < 512; ++k) importons.push_back({{(i - 255.5) / 128.0, 0.0, (k - 255.5) / 128.0}, 0.5});
  const ImportanceMap map(scene, importons);
  const double density = 0.5 * 512 * 512 / 16.0;
  // Areas are estimated from 64 points per cube.
  for (const glm::dvec3 at : {glm::dvec3(0.03, 0, 0.03), glm::dvec3(-1.9, 0, 1.9), glm::dvec3(1.3, 0, -0.7)})
    EXPECT_NEAR(map.at(at), density, 0.15 * density);
  EXPECT_GT(map.at({0, 3, 0}), 0.0);
}

}  // namespace
}  // namespace prelight::test

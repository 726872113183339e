#include "photon/photon_tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "base/directions.h"
#include "photon/caustic_light.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/devices.h"
#include "support/materials.h"
#include "support/scenes.h"

namespace prelight::test {
namespace {

using std::numbers::pi;

struct Flight {
  PhotonHits hits;
  PhotonReport report;

  glm::dvec3 storedPower() const {
    glm::dvec3 sum(0.0);
    for (const device::Photon& p : hits.photons) sum += glm::dvec3(p.power[0], p.power[1], p.power[2]);
    return sum;
  }
  glm::dvec3 emitted() const { return report.power.watts(report.power.emitted); }
  glm::dvec3 escaped() const { return report.power.watts(report.power.escaped); }
  glm::dvec3 absorbed() const { return report.power.watts(report.power.absorbed); }
};

Flight fly(const CompiledScene& scene, const std::vector<Light>& lights, const PhotonRequest& request,
           const Environment* sky = nullptr) {
  TransportScene transport({scene, noImages(), lights, sky}, sharedDevice());
  PhotonTracer tracer(scene, transport);
  Flight flight;
  Progress progress;
  flight.report = tracer.trace(request, flight.hits, progress);
  return flight;
}

PhotonRequest requestOf(PhotonKind kind, std::uint64_t photons) {
  PhotonRequest request;
  request.kind = kind;
  request.photons = photons;
  return request;
}

Light pointLight(const glm::dvec3& position, const glm::vec3& intensity) {
  Light light;
  light.type = LightType::Point;
  light.position = position;
  light.intensity = intensity;
  return light;
}

CompiledScene builtin(const std::string& name) {
  Warnings warnings;
  return compileScene(loadScene(makeBuiltinScene(name), warnings), warnings);
}

void expectBalanced(const PhotonPower& p) {
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(p.emitted[c], p.absorbed[c] + p.escaped[c] + p.cut[c]) << c;
}

/// Gives the last triangles of a scene a material of their own.
void paintLast(CompiledScene& scene, std::size_t triangles, const CompiledMaterial& material) {
  scene.materials.push_back(material);
  for (std::size_t t = scene.triangleCount() - triangles; t < scene.triangleCount(); ++t)
    scene.triangleMaterials[t] = static_cast<std::uint32_t>(scene.materials.size() - 1);
}

CompiledScene floorOf(float half, float height = 0.0f) {
  CompiledScene scene = ground(1, half, height);
  scene.materials[0] = lambert(1.0f);
  return scene;
}

/// A room with walls of one albedo.
CompiledScene room(float albedo) {
  CompiledScene scene = box(1, glm::vec3(-1.0f), glm::vec3(1.0f), true);
  scene.materials[0] = lambert(albedo);
  return scene;
}

// A photon's share of so many would not be a normal float: dividing by it would lose most digits.
TEST(PhotonPower, OfLittleLightAndVeryManyPhotons_IsCountedInNormalFloats) {
  const CompiledScene scene = room(0.0f);
  TransportScene transport({scene, noImages(), {pointLight({}, glm::vec3(1e-28f))}}, sharedDevice());
  const PhotonSources sources = allSources(scene, transport.lights(), 1000000000, 0);
  std::vector<std::uint32_t> numbers(1000);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::uint32_t>(999999 * i);
  PhotonTracer tracer(scene, transport);
  PhotonHits hits;
  Progress progress;
  const PhotonReport report =
      tracer.trace(requestOf(PhotonKind::All, 1000000000), sources, 0, numbers, hits, progress);
  const double expected = 4.0 * pi * 1e-28 * 1e-6;
  EXPECT_NEAR(report.power.watts(report.power.emitted).x / expected, 1.0, 0.01);
}

TEST(PhotonPower, EveryScene_IsAccountedForToTheLastCount) {
  for (const std::string name : {"cornell", "caustics", "shapes", "rooms"}) {
    SCOPED_TRACE(name);
    const CompiledScene scene = builtin(name);
    for (const PhotonKind kind : {PhotonKind::All, PhotonKind::Indirect, PhotonKind::Caustic}) {
      const Flight flight = fly(scene, scene.lights, requestOf(kind, 20000));
      expectBalanced(flight.report.power);
      EXPECT_EQ(flight.hits.photons.size(), flight.report.stored);
      EXPECT_EQ(flight.hits.paths.size(), flight.report.stored);
    }
  }
}

TEST(PhotonPower, TranslucentSurfaces_AreAccountedForToTheLastCount) {
  for (const float specular : {0.0f, 1.0f})
    for (const float share : {0.4f, 1.0f}) {
      CompiledScene scene = room(0.7f);
      append(scene, sphere(6, 0.5f, {0.2f, -0.1f, 0.0f}));
      scene.materials.back() = translucent(0.9f, share, 0.8f);
      scene.materials.back().specular = specular;
      scene.materials.back().roughness = 0.6f;
      for (const PhotonKind kind : {PhotonKind::All, PhotonKind::Indirect})
        expectBalanced(
            fly(scene, {pointLight({0.2, -0.1, 0.0}, glm::vec3(1.0f))}, requestOf(kind, 20000)).report.power);
    }
}

/// A lamp in a ball that transmits 0.8 of the light and reflects none. Without a room around it the
/// transmitted light escapes, and the rest is absorbed.
TEST(PhotonPower, LampInATranslucentBall_SendsItsShareOutside) {
  CompiledScene scene = sphere(16, 0.5f, {0, 0, 0});
  scene.materials[0] = translucent(0.9f, 1.0f, 0.8f);
  const Flight flight =
      fly(scene, {pointLight({0.1, 0, 0}, glm::vec3(1.0f))}, requestOf(PhotonKind::All, 1 << 16));
  expectBalanced(flight.report.power);
  EXPECT_NEAR(flight.escaped().x, 0.8 * 4.0 * pi, 0.01 * 4.0 * pi);
  EXPECT_NEAR(flight.storedPower().x, 4.0 * pi, 1e-3);
  // No photon may land on the outside of the ball.
  for (const device::Photon& p : flight.hits.photons) {
    const glm::dvec3 from(unpackDirection(p.direction));
    ASSERT_LT(glm::dot(from, glm::dvec3(p.position[0], p.position[1], p.position[2])), 0.0);
  }
}

/// A sheet between lamp and floor transmits a share of the lamp's light, with a cosine distribution. The
/// floor receives the sheet's form factor of it, here nearly 1.
TEST(PhotonTransport, ThroughASheet_LandsBehindIt) {
  CompiledScene scene = floorOf(20.0f);
  append(scene, ground(1, 1.0f, 0.2f));
  scene.materials[0] = lambert(0.0f);
  scene.materials[1] = translucent(0.9f, 0.5f, 0.6f);
  // The floor stores photons and reflects none.
  scene.materials[0].baseColor = scene.materials[0].albedo = glm::vec3(1e-6f);
  Light sun;
  sun.type = LightType::Directional;
  sun.intensity = glm::vec3(1.0f);
  sun.direction = {0, -1, 0};
  const Flight flight = fly(scene, {sun}, requestOf(PhotonKind::Indirect, 1 << 20));
  double below = 0.0;
  for (const device::Photon& p : flight.hits.photons)
    if (p.position[1] < 0.1f) below += double(p.power[0]);
  // 4 m2 of sheet receive 1 W/m2. Less than a ten thousandth of it lands more than 20 m away.
  EXPECT_NEAR(below, 4.0 * 0.5 * 0.6, 0.05);
}

TEST(PhotonPower, DepthCutsPaths_AndCountsWhatTheyCarried) {
  PhotonRequest request = requestOf(PhotonKind::All, 10000);
  request.depth = 2;
  request.rouletteDepth = 8;
  const Flight flight = fly(room(0.5f), {pointLight({0, 0, 0}, glm::vec3(1.0f))}, request);
  expectBalanced(flight.report.power);
  EXPECT_NEAR(flight.report.power.watts(flight.report.power.cut).x, 4.0 * pi / 4.0, 1e-4);
}

TEST(PhotonEmission, EachKindOfLight_SendsItsPower) {
  const CompiledScene scene = room(0.0f);
  const double radius = std::sqrt(3.0);
  Light light = pointLight({0.2, 0, 0}, {1.0f, 2.0f, 3.0f});
  const PhotonRequest request = requestOf(PhotonKind::All, 1 << 16);
  EXPECT_NEAR(fly(scene, {light}, request).emitted().y, 8.0 * pi, 1e-5);
  light.type = LightType::Spot;
  light.innerConeAngle = 0.3f;
  light.outerConeAngle = 0.6f;
  light.direction = glm::normalize(glm::dvec3(1, 2, 3));
  const double a = std::cos(0.6), b = std::cos(0.3);  // The falloff is the square of a ramp between these.
  EXPECT_NEAR(fly(scene, {light}, request).emitted().y, 2.0 * 2.0 * pi * ((1.0 - b) + (b - a) / 3.0), 1e-4);
  light.type = LightType::Directional;
  EXPECT_NEAR(fly(scene, {light}, request).emitted().y, 2.0 * pi * radius * radius, 1e-4);

  CompiledScene lamp = room(0.0f);
  append(lamp, ground(1, 0.5f, 0.2f));
  paintLast(lamp, 2, emitter({2.0f, 3.0f, 4.0f}));
  EXPECT_NEAR(fly(lamp, {}, request).emitted().y, 3.0 * pi, 1e-5);
  lamp.materials.back().doubleSided = true;
  EXPECT_NEAR(fly(lamp, {}, request).emitted().y, 6.0 * pi, 1e-5);

  const Environment sky = constantEnvironment({1.0f, 2.0f, 1.0f});
  EXPECT_NEAR(fly(scene, {}, request, &sky).emitted().y, 2.0 * 4.0 * pi * pi * radius * radius, 2e-2);
}

TEST(PhotonEmission, RangeOfALight_TakesPowerAway) {
  Light light = pointLight({0, 0, 0}, glm::vec3(1.0f));
  light.range = 0.9f;  // The walls are farther away.
  EXPECT_EQ(fly(room(0.5f), {light}, requestOf(PhotonKind::All, 4096)).storedPower().x, 0.0);
}

TEST(PhotonEmission, NoLight_SendsNothing) {
  const Flight flight = fly(room(0.5f), {}, requestOf(PhotonKind::All, 1000));
  EXPECT_EQ(flight.report.emitted, 0u);
  EXPECT_TRUE(flight.hits.photons.empty());
}

/// A closed room of albedo a receives the light's power over 1 - a.
TEST(PhotonTracer, ClosedRoom_GathersItsGeometricSeries) {
  for (const float albedo : {0.01f, 0.5f, 0.9f, 0.99f}) {
    const Flight flight = fly(room(albedo), {pointLight({0.1, 0.2, 0.3}, glm::vec3(1.0f))},
                              requestOf(PhotonKind::All, 1 << 17));
    const double expected = 4.0 * pi / (1.0 - static_cast<double>(albedo));
    // The number of hits per photon is geometric, with a relative deviation of sqrt(albedo).
    const double sigma = std::sqrt(static_cast<double>(albedo) / (1 << 17));
    EXPECT_NEAR(flight.storedPower().x, expected, 3.0 * sigma * expected) << albedo;
    EXPECT_NEAR(flight.escaped().x, 0.0, 1e-12);
    expectBalanced(flight.report.power);
  }
}

TEST(PhotonTracer, ColouredWalls_KeepTheMeanOfEachChannel) {
  CompiledScene scene = room(0.5f);
  scene.materials[0].albedo = scene.materials[0].baseColor = {0.9f, 0.5f, 0.1f};
  const Flight flight =
      fly(scene, {pointLight({0.1, 0.2, 0.3}, glm::vec3(1.0f))}, requestOf(PhotonKind::All, 1 << 17));
  EXPECT_NEAR(flight.storedPower().x, 4.0 * pi / 0.1, 3e-3 * 4.0 * pi / 0.1);
  EXPECT_NEAR(flight.storedPower().y, 4.0 * pi / 0.5, 3e-3 * 4.0 * pi / 0.5);
  EXPECT_NEAR(flight.storedPower().z, 4.0 * pi / 0.9, 3e-3 * 4.0 * pi / 0.9);
}

TEST(PhotonTracer, Flux_DoesNotDependOnTheNumberOfPhotons) {
  const CompiledScene scene = builtin("cornell");
  const double most = fly(scene, scene.lights, requestOf(PhotonKind::Indirect, 1 << 19)).storedPower().y;
  for (const int count : {1 << 12, 1 << 14, 1 << 16}) {
    const double found = fly(scene, scene.lights, requestOf(PhotonKind::Indirect, count)).storedPower().y;
    EXPECT_NEAR(found, most, 3.0 * most / std::sqrt(count)) << count;
  }
}

TEST(PhotonTracer, SameSeed_GivesTheSameHitsInTheSameOrder) {
  const CompiledScene scene = builtin("caustics");
  PhotonRequest request = requestOf(PhotonKind::Indirect, 100000);  // More than a block.
  const Flight a = fly(scene, scene.lights, request), b = fly(scene, scene.lights, request);
  ASSERT_EQ(a.hits.photons.size(), b.hits.photons.size());
  EXPECT_EQ(0, std::memcmp(a.hits.photons.data(), b.hits.photons.data(),
                           a.hits.photons.size() * sizeof(device::Photon)));
  EXPECT_EQ(a.hits.paths, b.hits.paths);
  request.seed = 1;
  const Flight c = fly(scene, scene.lights, request);
  EXPECT_NE(a.hits.photons.size(), c.hits.photons.size());
}

/// Power on a floor under a point light, square by square, compared with its integral in closed form.
TEST(PhotonTracer, FloorUnderAPointLight_GetsTheInverseSquare) {
  const CompiledScene scene = floorOf(2.0f);
  const Flight flight =
      fly(scene, {pointLight({0, 1, 0}, glm::vec3(1.0f))}, requestOf(PhotonKind::All, 1 << 19));
  constexpr int cells = 8;
  std::vector<double> found(cells * cells, 0.0);
  for (const device::Photon& p : flight.hits.photons) {
    const int x = std::min(cells - 1, static_cast<int>((p.position[0] + 2.0f) * cells / 4.0f));
    const int z = std::min(cells - 1, static_cast<int>((p.position[2] + 2.0f) * cells / 4.0f));
    found[static_cast<std::size_t>(z * cells + x)] += static_cast<double>(p.power[0]);
  }
  // Solid angle of a corner rectangle [0,x] x [0,z] at height 1.
  const auto corner = [](double x, double z) { return std::atan(x * z / std::sqrt(1.0 + x * x + z * z)); };
  for (int z = 0; z < cells; ++z)
    for (int x = 0; x < cells; ++x) {
      const double x0 = -2.0 + 0.5 * x, z0 = -2.0 + 0.5 * z, x1 = x0 + 0.5, z1 = z0 + 0.5;
      const double expected = corner(x1, z1) - corner(x0, z1) - corner(x1, z0) + corner(x0, z0);
      EXPECT_NEAR(found[static_cast<std::size_t>(z * cells + x)], expected, 0.02 * expected) << x << ' ' << z;
    }
}

TEST(PhotonTracer, SealedRooms_KeepPhotonsOnTheLightsSideOfTheWall) {
  const CompiledScene scene = builtin("rooms-sealed");
  const Flight flight = fly(scene, scene.lights, requestOf(PhotonKind::All, 1 << 18));
  ASSERT_GT(flight.hits.photons.size(), std::size_t{1} << 18);
  for (const device::Photon& p : flight.hits.photons)
    ASSERT_LT(static_cast<double>(p.position[0]) + scene.origin.x, 0.0);
  EXPECT_EQ(flight.escaped(), glm::dvec3(0.0));
}

TEST(PhotonTracer, GlassWithAbsorption_FollowsBeersLaw) {
  CompiledScene scene = floorOf(50.0f, -2.0f);
  append(scene, box(1, {-20.0f, -0.25f, -20.0f}, {20.0f, 0.25f, 20.0f}, false));
  CompiledMaterial slab = glass(1.0f, true);
  slab.absorption = glm::vec3(2.0f);
  paintLast(scene, 12, slab);
  Light sun;
  sun.type = LightType::Directional;
  sun.direction = {0, -1, 0};
  sun.intensity = glm::vec3(1.0f);
  const Flight flight = fly(scene, {sun}, requestOf(PhotonKind::Caustic, 1 << 17));
  EXPECT_NEAR(flight.storedPower().x, 1600.0 * std::exp(-1.0), 0.01 * 1600.0 * std::exp(-1.0));
}

/// A lens above a floor.
CompiledScene lensScene() {
  CompiledScene scene = floorOf(3.0f);
  append(scene, sphere(24, 0.5f, {0.3f, 1.0f, 0.0f}));
  scene.triangleFlat.assign(scene.triangles.size(), 1);
  paintLast(scene, scene.triangleCount() - 2, glass(1.5f, true));
  return scene;
}

TEST(CausticPhotons, AimedOrNot_CarryTheSamePower) {
  Light sun;
  sun.type = LightType::Directional;
  sun.direction = glm::normalize(glm::dvec3(-0.3, -1, 0.1));
  sun.intensity = glm::vec3(2.0f);
  Light spot = pointLight({-0.5, 2.5, 0.3}, glm::vec3(3.0f));
  spot.type = LightType::Spot;
  spot.direction = glm::normalize(glm::dvec3(0.5, -1, -0.3));
  spot.outerConeAngle = 0.8f;
  const Environment sky = constantEnvironment(glm::vec3(0.5f));
  CompiledScene lamp = lensScene();
  append(lamp, ground(1, 0.2f, 3.0f));
  paintLast(lamp, 2, emitter(glm::vec3(5.0f)));
  lamp.materials.back().doubleSided = true;
  lamp.triangleFlat.assign(lamp.triangles.size(), 1);
  const struct {
    const char* name;
    CompiledScene scene;
    std::vector<Light> lights;
    const Environment* sky;
  } cases[] = {{"sun", lensScene(), {sun}, nullptr},
               {"point", lensScene(), {pointLight({1, 2, 1}, glm::vec3(3.0f))}, nullptr},
               {"spot", lensScene(), {spot}, nullptr},
               {"lamp", lamp, {}, nullptr},
               {"sky", lensScene(), {}, &sky},
               {"all", lamp, {sun, spot}, &sky}};
  for (const auto& c : cases) {
    PhotonRequest request = requestOf(PhotonKind::Caustic, 1 << 18);
    const Flight aimed = fly(c.scene, c.lights, request, c.sky);
    request.aimed = false;
    const Flight everywhere = fly(c.scene, c.lights, request, c.sky);
    const double a = aimed.storedPower().x, b = everywhere.storedPower().x;
    // Independent photons would scatter by the square root of their number; these scatter less.
    const double sigma = b / std::sqrt(static_cast<double>(everywhere.hits.photons.size()));
    EXPECT_NEAR(a, b, 3.0 * sigma) << c.name;
    EXPECT_GT(aimed.hits.photons.size(), 2 * everywhere.hits.photons.size()) << c.name;
  }
}

/// Nothing absorbs the light.
TEST(PhotonTracer, RoomOfPerfectMirrors_IsLeftByAllPhotons) {
  CompiledScene scene = room(0.0f);
  scene.materials[0] = metal(1.0f, 0.0f);
  const Flight flight =
      fly(scene, {pointLight({0.1, 0.2, 0.3}, glm::vec3(1.0f))}, requestOf(PhotonKind::All, 1 << 14));
  EXPECT_EQ(flight.report.power.cut[0], 0);
  EXPECT_LT(flight.report.rays, 60u * flight.report.emitted);
  expectBalanced(flight.report.power);
}

/// A narrow beam from the top of a shaft of perfect mirrors hits about fifty of them on its way to the floor.
TEST(PhotonTracer, ManyMirrorsInARow_BringAllThePowerToTheFloor) {
  CompiledScene scene = floorOf(0.1f, 0.001f);
  append(scene, box(1, {-0.1f, 0.0f, -0.1f}, {0.1f, 1.05f, 0.1f}, true));
  paintLast(scene, 12, metal(1.0f, 0.0f));
  scene.triangleFlat.assign(scene.triangles.size(), 1);
  Light beam = pointLight({0, 1, 0}, glm::vec3(1.0f));
  beam.type = LightType::Spot;
  beam.direction = glm::normalize(glm::dvec3(10.6, -1, 0));
  beam.outerConeAngle = 0.006f;
  PhotonRequest request = requestOf(PhotonKind::Caustic, 1 << 16);
  request.aimed = false;
  const Flight flight = fly(scene, {beam}, request);
  EXPECT_GT(flight.report.rays, 50u * flight.report.stored);
  EXPECT_NEAR(flight.storedPower().x / flight.emitted().x, 1.0, 0.02);
}

TEST(CausticPhotons, SceneWithoutCasters_SendsNone) {
  const Flight flight =
      fly(room(0.5f), {pointLight({0, 0, 0}, glm::vec3(1.0f))}, requestOf(PhotonKind::Caustic, 1000));
  EXPECT_EQ(flight.report.emitted, 0u);
  EXPECT_EQ(flight.report.rays, 0u);
}

TEST(CausticPhotons, Mirror_ThrowsWhatItReceives) {
  // A mirror on the floor of the room reflects a lamp's light to the ceiling.
  CompiledScene scene = box(1, {-10.0f, -1.0f, -10.0f}, {10.0f, 4.0f, 10.0f}, true);
  scene.materials[0] = lambert(0.5f);
  append(scene, ground(1, 1.0f));
  paintLast(scene, 2, metal(0.8f, 0.0f));
  scene.triangleFlat.assign(scene.triangles.size(), 1);
  PhotonRequest request = requestOf(PhotonKind::Caustic, 1 << 16);
  request.rouletteDepth = 8;
  const Flight flight = fly(scene, {pointLight({0, 1, 0}, glm::vec3(1.0f))}, request);
  EXPECT_NEAR(flight.storedPower().x, 0.8 * 4.0 * std::atan(1.0 / std::sqrt(3.0)), 2e-3);
}

/// Power that a square of 2 x 2 m absorbs from a sun straight above it of 1 W/m2, relative to the power that
/// arrives. Its shading normals are tilted by `tilt`.
double absorbedUnderTheSun(const CompiledMaterial& material, double tilt) {
  CompiledScene scene = ground(1, 1.0f);
  scene.materials[0] = material;
  for (glm::vec3& n : scene.normals) n = glm::vec3(std::sin(tilt), std::cos(tilt), 0.0);
  Light sun;
  sun.type = LightType::Directional;
  sun.direction = {0, -1, 0};
  sun.intensity = glm::vec3(1.0f);
  PhotonRequest request = requestOf(PhotonKind::Caustic, 1 << 17);
  request.rouletteDepth = 8;
  return fly(scene, {sun}, request).absorbed().x / 4.0;
}

double fresnel(double cosine, double eta) {
  const double beyond = std::sqrt(1.0 - (1.0 - cosine * cosine) / (eta * eta));
  const double s = (cosine - eta * beyond) / (cosine + eta * beyond),
               p = (eta * cosine - beyond) / (eta * cosine + beyond);
  return 0.5 * (s * s + p * p);
}

/// Camera paths see the radiance R L. The flux of that radiance is R |out.Ng| / |in.Ng| of the power that
/// arrived.
TEST(ShadingNormals, OfAMirror_ScaleThePowerThatLeaves) {
  for (const double tilt : {0.0, 0.3, pi / 6.0, 0.7})
    EXPECT_NEAR(absorbedUnderTheSun(metal(0.9f, 0.0f), tilt), 1.0 - 0.9 * std::cos(2.0 * tilt), 0.005)
        << tilt;
}

/// Reflection scales as for a mirror; refraction scales by |in.Ns| |out.Ng| / (|in.Ng| |out.Ns|).
TEST(ShadingNormals, OfGlass_ScaleThePowerThatLeaves) {
  for (const double tilt : {0.0, 0.3, pi / 6.0}) {
    const double beyond = std::asin(std::sin(tilt) / 1.5), reflected = fresnel(std::cos(tilt), 1.5);
    const double leaves = reflected * std::cos(2.0 * tilt) +
                          (1.0 - reflected) * std::cos(tilt) * std::cos(tilt - beyond) / std::cos(beyond);
    EXPECT_NEAR(absorbedUnderTheSun(glass(1.5f, true), tilt), 1.0 - leaves, 0.005) << tilt;
  }
}

/// These normals are tilted so far that they would reflect light into the surface; camera paths then use the
/// triangle's own normal. From straight above they see 0.04 of the light above reflected in this way. From
/// straight below the shading normal reflects totally, and into the surface, so that they see 0.96 of the
/// light above through the triangle's own normal. Light that the shading normal refracts is added: more light
/// leaves than arrives.
TEST(ShadingNormals, OfGlassTiltedTooFar_SendLightWhereverTheEyeSeesItFrom) {
  const double tilt = 50.0 / 180.0 * pi;
  const double beyond = std::asin(std::sin(tilt) / 1.5), reflected = fresnel(std::cos(tilt), 1.5);
  const double bent = (1.0 - reflected) * std::cos(tilt) * std::cos(tilt - beyond) / std::cos(beyond);
  EXPECT_NEAR(absorbedUnderTheSun(glass(1.5f, true), tilt), 1.0 - (bent + 0.04 + 0.96), 0.005);
}

/// A thin pane passes light straight whatever its shading normals; only its reflection is scaled.
TEST(ShadingNormals, OfThinGlass_ScaleWhatIsReflectedAlone) {
  const double tilt = pi / 6.0, face = fresnel(std::cos(tilt), 1.5), reflected = 2.0 * face / (1.0 + face);
  EXPECT_NEAR(absorbedUnderTheSun(glass(1.5f, false), tilt), reflected * (1.0 - std::cos(2.0 * tilt)), 0.002);
}

TEST(CausticPhotons, UsualRequest_LetsADarkMirrorWeakenPhotonsAndNotEndThem) {
  CompiledScene scene = box(1, {-10.0f, -1.0f, -10.0f}, {10.0f, 4.0f, 10.0f}, true);
  scene.materials[0] = lambert(0.5f);
  append(scene, ground(1, 1.0f));
  paintLast(scene, 2, metal(0.1f, 0.0f));
  scene.triangleFlat.assign(scene.triangles.size(), 1);
  const Flight flight = fly(scene, {pointLight({0, 1, 0}, glm::vec3(1.0f))}, causticRequest(4096));
  const double sent = flight.emitted().x / double(flight.report.emitted);
  ASSERT_FALSE(flight.hits.photons.empty());
  for (const device::Photon& photon : flight.hits.photons) {
    // Cosine with the mirror's normal, too.
    const double cosine = std::abs(unpackDirection(photon.direction).y);
    EXPECT_NEAR(photon.power[0], (0.1 + 0.9 * std::pow(1.0 - cosine, 5.0)) * sent, 0.01 * sent);
  }
}

// In a diffuse sphere around a point light, reflected photons fly along chords. The slope of a chord is
// independent of its start on the sphere, which follows from its end and direction: the mean of each product
// of the two is 0.
TEST(PhotonTracer, Directions_AreIndependentOfThoseBefore) {
  CompiledScene scene = sphere(48, 1.0f, glm::vec3(0.0f));
  for (glm::uvec3& t : scene.triangles) std::swap(t.y, t.z);
  for (glm::vec3& n : scene.normals) n = -n;
  scene.materials[0] = lambert(0.5f);
  PhotonRequest request = requestOf(PhotonKind::Indirect, 40000);
  const Flight flight = fly(scene, {pointLight(glm::dvec3(0.0), glm::vec3(1.0f))}, request);
  std::size_t count = 0;
  glm::dvec3 first(0.0), second(0.0);
  for (const device::Photon& p : flight.hits.photons) {
    const glm::dvec3 end(p.position[0], p.position[1], p.position[2]);
    const glm::dvec3 from(unpackDirection(p.direction));
    const double cosine = -glm::dot(end, from);
    const glm::dvec3 begin = end + 2.0 * cosine * from;
    ++count;
    // By Lambert's law the squared cosine is uniform in [0, 1].
    first += (cosine * cosine - 0.5) * begin;
    second += (cosine * cosine - 0.5) * (begin * begin - 1.0 / 3.0);
  }
  ASSERT_GT(count, 10000u);
  const double bound = 5.0 * 0.29 * 0.58 / std::sqrt(double(count));  // Five standard errors.
  for (int c = 0; c < 3; ++c) {
    EXPECT_LE(std::abs(first[c]) / double(count), bound) << c;
    EXPECT_LE(std::abs(second[c]) / double(count), bound) << c;
  }
}

}  // namespace
}  // namespace prelight::test

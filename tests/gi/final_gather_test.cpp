#include "gi/final_gather.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "charts/make_light_map_layout.h"
#include "receivers/surface_sampler.h"
#include "support/devices.h"
#include "support/ggx_albedo.h"
#include "support/materials.h"
#include "support/scenes.h"

namespace prelight::test {
namespace {

/// A closed room whose walls have one irradiance each, and the light that receivers on the floor gather from
/// them.
struct GatherRoom {
  CompiledScene scene = box(1, glm::vec3(-1.0f), glm::vec3(1.0f), true);
  GatherRequest request;
  const Environment* sky = nullptr;
  std::vector<Light> lights;

  std::vector<glm::vec3> gather(const glm::vec3& irradiance) const {
    TransportScene transport({scene, noImages(), lights, sky}, sharedDevice());
    IrradianceMap map(transport.context(), layout());
    map.set(std::vector<glm::vec3>(layout().texelCount(), irradiance));
    FinalGather gatherer(transport, map, request);
    Progress progress;
    return gatherer.gather(receivers(), progress);
  }

  /// A layout with one texel, which all faces use except those in `leftOut`.
  LightMapLayout layout() const {
    LightMapLayout l;
    l.width = l.height = 1;
    l.corners.assign(6 * std::size_t{scene.triangleCount()}, glm::vec2(0.5f));
    l.chartOf.assign(2 * std::size_t{scene.triangleCount()}, 0);
    for (const std::uint32_t face : leftOut) l.chartOf[face] = LightMapLayout::noChart;
    return l;
  }

  std::vector<device::Receiver> receivers() const {
    std::vector<device::Receiver> all;
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
      if (scene.triangleMaterials[t] != 0) continue;
      for (std::uint32_t i = 0; i < 20; ++i) {
        SurfaceSample sample{t, 0.05f + 0.03f * static_cast<float>(i % 5),
                             0.1f + 0.15f * static_cast<float>(i / 5), 1.0f};
        all.push_back(receiverAt(scene, sample, Side::Front));
        all.back().seed = 17 * t + i;
        all.back().firstSample = 0;
      }
    }
    return all;
  }

  std::vector<std::uint32_t> leftOut;
};

void expectAll(const std::vector<glm::vec3>& found, const glm::vec3& expected, double tolerance) {
  ASSERT_FALSE(found.empty());
  for (const glm::vec3& e : found)
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(e[c], expected[c], tolerance);
}

TEST(FinalGather, ClosedRoom_GathersAlbedoTimesIrradiance) {
  GatherRoom room;
  room.scene.materials[0] = lambert(0.5f);
  room.scene.materials[0].baseColor = {0.5f, 0.25f, 1.0f};
  for (const std::uint32_t rays : {8u, 64u, 256u}) {
    room.request.raysPerReceiver = rays;
    expectAll(room.gather({1.0f, 2.0f, 3.0f}), {0.5f, 0.5f, 3.0f}, 1e-5);
  }
}

TEST(FinalGather, Mirrors_AreFollowedToWhatTheyShow) {
  GatherRoom room;
  room.scene.materials[0] = lambert(0.5f);
  room.scene.materials.push_back(metal(1.0f, 0.0f));
  for (const std::uint32_t t : {0u, 1u, 6u, 7u}) room.scene.triangleMaterials[t] = 1;
  room.request.depth = 200;
  expectAll(room.gather(glm::vec3(1.0f)), glm::vec3(0.5f), 1e-4);
}

/// A ball of clear glass in a grey room.
GatherRoom roomAroundGlass() {
  GatherRoom room;
  room.scene.materials[0] = lambert(0.5f);
  append(room.scene, sphere(8, 0.4f, {0.0f, 0.0f, 0.0f}));
  room.scene.triangleFlat.assign(room.scene.triangles.size(), 1);
  room.scene.materials[1] = glass(1.5f, true);
  room.scene.materials[1].baseColor = glm::vec3(1.0f);
  room.request.depth = 200;
  return room;
}

TEST(FinalGather, Glass_LetsLightThrough) {
  GatherRoom room = roomAroundGlass();
  expectAll(room.gather(glm::vec3(1.0f)), glm::vec3(0.5f), 1e-4);
}

TEST(FinalGather, ShortenedWays_LetAsMuchLightThroughInTheMean) {
  GatherRoom room = roomAroundGlass();
  room.request.longWay = 2;
  glm::dvec3 sum(0.0);
  double apart = 0.0;
  const std::vector<glm::vec3> found = room.gather(glm::vec3(1.0f));
  for (const glm::vec3& e : found) {
    sum += glm::dvec3(e);
    apart = std::max(apart, std::abs(static_cast<double>(e.x) - 0.5));
  }
  EXPECT_GT(apart, 1e-4);  // Otherwise no path was shortened.
  EXPECT_NEAR(sum.x / double(found.size()), 0.5, 4.0 * apart / std::sqrt(double(found.size())));
}

TEST(FinalGather, LampsSeenStraightOrInMirrors_DoNotCount) {
  GatherRoom room;
  room.scene.materials[0] = lambert(0.0f);
  room.scene.materials.push_back(emitter(glm::vec3(10.0f)));
  room.scene.materials.push_back(metal(1.0f, 0.0f));
  room.scene.triangleMaterials[0] = room.scene.triangleMaterials[1] = 1;
  room.scene.triangleMaterials[2] = room.scene.triangleMaterials[3] = 2;
  expectAll(room.gather(glm::vec3(0.0f)), glm::vec3(0.0f), 0.0);
}

/// BRDF of a GGX surface with this normal for a single reflection, in double precision (Walter et al. 2007,
/// eq. 33; Heitz 2014, eq. 99).
double ggxReflection(const glm::dvec3& n, const glm::dvec3& in, const glm::dvec3& out, double alpha) {
  const double a2 = alpha * alpha, ci = glm::dot(n, in), co = glm::dot(n, out);
  if (ci <= 0.0 || co <= 0.0) return 0.0;
  const double h = glm::dot(n, glm::normalize(in + out));
  const double q = h * h * (a2 - 1.0) + 1.0;
  const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1.0 + a2 * (1.0 - c * c) / (c * c)) - 1.0); };
  return a2 / (std::numbers::pi * q * q) / ((1.0 + lambda(ci) + lambda(co)) * 4.0 * ci * co);
}

/// A lamp that is small as seen from the receiver: W/sr along its normal, or in all directions if the normal
/// is 0.
struct SmallLamp {
  glm::dvec3 position;
  glm::dvec3 normal;
  double intensity;

  double towards(const glm::dvec3& direction) const {
    if (normal == glm::dvec3(0.0)) return intensity;
    return intensity * std::max(glm::dot(normal, direction), 0.0);
  }
};

/// Irradiance at a place on a wall of the room of half-width 1, by a midpoint sum over the wall at x = -1, a
/// white metal of this roughness. Light that stays in the microfacets at the first bounce leaves later, in
/// proportion to the share that stays for either direction (Kulla and Conty 2017). `staying` is that share
/// [cosine], `meanStaying` its mean.
double irradianceByRoughMetal(const std::vector<SmallLamp>& lamps, const device::Receiver& receiver,
                              double roughness, const std::vector<double>& staying, double meanStaying) {
  const glm::dvec3 place(receiver.position[0], receiver.position[1], receiver.position[2]);
  const glm::dvec3 normal(receiver.normal[0], receiver.normal[1], receiver.normal[2]);
  const double alpha = roughness * roughness;
  const auto stays = [&](double cosine) {
    return staying[std::size_t(cosine * double(staying.size() - 1) + 0.5)];
  };
  constexpr int cells = 20;
  constexpr double side = 2.0 / cells, area = side * side;
  double irradiance = 0.0;
  for (int m = 0; m < cells * cells; ++m) {
    const glm::dvec3 metal(-1.0, -1.0 + side * (m / cells + 0.5), -1.0 + side * (m % cells + 0.5));
    const glm::dvec3 way = metal - place, out = glm::normalize(-way);
    double radiance = 0.0;
    for (const SmallLamp& lamp : lamps) {
      const glm::dvec3 toLamp = lamp.position - metal;
      const glm::dvec3 in = glm::normalize(toLamp);
      const double later = stays(in.x) * stays(out.x) / (std::numbers::pi * meanStaying);
      radiance += lamp.towards(-in) * (ggxReflection({1.0, 0.0, 0.0}, in, out, alpha) + later) * in.x /
                  glm::dot(toLamp, toLamp);
    }
    irradiance += radiance * std::max(glm::dot(normal, -out), 0.0) * out.x * area / glm::dot(way, way);
  }
  return irradiance;
}

/// Ratio of gathered to expected light in a room whose wall at x = -1 is a metal of this roughness.
double gatheredByRoughMetal(const GatherRoom& room, const std::vector<SmallLamp>& lamps, double roughness) {
  const std::vector<glm::vec3> found = room.gather(glm::vec3(0.0f));
  std::vector<double> staying;
  for (int i = 0; i <= 128; ++i) {
    const glm::dvec2 once = reflectedOnce(std::max(i / 128.0, 1e-3), roughness, 200);
    staying.push_back(1.0 - once.x - once.y);
  }
  const double meanStaying = 1.0 - meanReflectedOnce(roughness);
  const std::vector<device::Receiver> receivers = room.receivers();
  double sum = 0.0, expected = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    sum += static_cast<double>(found[i].x);
    expected += irradianceByRoughMetal(lamps, receivers[i], roughness, staying, meanStaying);
  }
  return sum / expected;
}

TEST(FinalGather, LampsInRoughMetal_CountAsItsLobeReflectsThem) {
  GatherRoom room;
  room.scene.materials[0] = lambert(0.0f);
  room.scene.materials.push_back(emitter(glm::vec3(10.0f)));
  room.scene.materials.push_back(metal(1.0f, 0.8f));
  room.scene.triangleMaterials[0] = room.scene.triangleMaterials[1] = 1;
  room.scene.triangleMaterials[2] = room.scene.triangleMaterials[3] = 2;
  room.request.raysPerReceiver = 1024;
  std::vector<SmallLamp> wall;
  constexpr int cells = 20;
  constexpr double side = 2.0 / cells;
  for (int l = 0; l < cells * cells; ++l) {
    const glm::dvec3 middle(1.0, -1.0 + side * (l / cells + 0.5), -1.0 + side * (l % cells + 0.5));
    wall.push_back({middle, {-1.0, 0.0, 0.0}, 10.0 * side * side});
  }
  EXPECT_NEAR(gatheredByRoughMetal(room, wall, 0.8), 1.0, 0.02);
}

TEST(FinalGather, PointLightsInRoughMetal_CountAsItsLobeReflectsThem) {
  GatherRoom room;
  room.scene.materials[0] = lambert(0.0f);
  room.scene.materials.push_back(metal(1.0f, 0.6f));
  room.scene.triangleMaterials[2] = room.scene.triangleMaterials[3] = 1;
  room.request.raysPerReceiver = 1024;
  Light lamp;
  lamp.type = LightType::Point;
  lamp.position = {0.3f, 0.2f, -0.1f};
  lamp.intensity = glm::vec3(5.0f);
  room.lights = {lamp};
  const std::vector<SmallLamp> lamps = {{glm::dvec3(lamp.position), glm::dvec3(0.0), 5.0}};
  EXPECT_NEAR(gatheredByRoughMetal(room, lamps, 0.6), 1.0, 0.02);
}

TEST(FinalGather, SkyBehindAnOpening_IsDirectLight) {
  GatherRoom room;
  room.scene = ground(1, 1.0f);
  room.scene.materials[0] = lambert(0.5f);
  const Environment sky = constantEnvironment(glm::vec3(1.0f));
  room.sky = &sky;
  expectAll(room.gather(glm::vec3(1.0f)), glm::vec3(0.0f), 0.0);
}

TEST(FinalGather, FacesWithoutChart_AreBlack) {
  GatherRoom room;
  room.scene.materials[0] = lambert(0.5f);
  for (std::uint32_t t = 0; t < room.scene.triangleCount(); ++t) room.leftOut.push_back(t);
  expectAll(room.gather(glm::vec3(1.0f)), glm::vec3(0.0f), 0.0);
}

TEST(FinalGather, SameSeed_GivesTheSameBits_AnotherSeedOthers) {
  GatherRoom room;
  room.scene.materials[0] = lambert(0.5f);
  room.scene.materials.push_back(metal(0.8f, 0.3f));
  room.scene.triangleMaterials[0] = 1;
  const std::vector<glm::vec3> first = room.gather(glm::vec3(1.0f)), again = room.gather(glm::vec3(1.0f));
  EXPECT_EQ(first, again);
  room.request.seed = 1;
  EXPECT_NE(first, room.gather(glm::vec3(1.0f)));
}

}  // namespace
}  // namespace prelight::test

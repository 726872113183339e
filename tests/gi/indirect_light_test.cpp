#include "gi/indirect_light.h"
#include "basis/sh_evaluate.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "charts/direct_light.h"
#include "charts/make_light_map_layout.h"
#include "charts/wall_search.h"
#include "receivers/surface_sampler.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/devices.h"
#include "support/mapped_irradiance.h"
#include "support/materials.h"
#include "support/scenes.h"

namespace prelight::test {
namespace {

using std::numbers::pi;

struct IndirectScene {
  Scene source;
  CompiledScene scene;
  std::vector<Light> lights;
  LightMapLayout layout;
  IndirectRequest request;

  std::vector<glm::vec3> gather() {
    std::vector<glm::vec3> found;
    light([&](IndirectLight& indirect, Progress& progress) {
      found = indirect.gather(layout.texels, progress);
    });
    return found;
  }

  std::vector<float> gatherIncident(int order = leastIncidentOrder) {
    std::vector<float> found;
    light([&](IndirectLight& indirect, Progress& progress) {
      found = indirect.gatherIncident(layout.texels, progress, order);
    });
    return found;
  }

  template <typename Use>
  void light(const Use& use) {
    const LitScene lit{scene, source.images, lights};
    TransportScene transport(lit, sharedDevice());
    const DensitySurface surface =
        makeDensitySurface(scene, makeSurfaceRegions(scene, LightMapLayoutRequest{}.creaseAngle));
    Progress progress;
    findWalls(scene, transport.tracer(), layout);
    const SurfacePatches patches(scene, transport.tracer(), layout, surface);
    IndirectLight light(lit, transport, patches, surface, request, sharedDevice(),
                        sendPhotons(scene, transport, indirectPhotons(transport, request), progress));
    use(light, progress);
  }
};

IndirectScene builtinLight(const std::string& name, std::uint32_t texels) {
  IndirectScene light;
  Warnings warnings;
  light.source = loadScene(makeBuiltinScene(name), warnings);
  light.scene = compileScene(light.source, warnings);
  light.lights = light.source.lights;
  LightMapLayoutRequest map;
  map.texels = texels;
  light.layout = makeLightMapLayout(light.source, light.scene, map);
  return light;
}

double worldX(const CompiledScene& scene, std::uint32_t face) {
  const std::uint32_t t = face % scene.triangleCount();
  return static_cast<double>(scene.positions[scene.triangles[t].x].x) + scene.origin.x;
}

TEST(IndirectLight, SealedRooms_LetNothingThroughTheWall) {
  IndirectScene light = builtinLight("rooms-sealed", 4096);
  const std::vector<glm::vec3> found = light.gather();
  double lit = 0.0, dark = 0.0;
  std::size_t litCount = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double e = static_cast<double>(std::max({found[i].x, found[i].y, found[i].z}));
    if (worldX(light.scene, light.layout.texels[i].face) < 0.0) {
      lit += e;
      ++litCount;
    } else {
      dark = std::max(dark, e);
    }
  }
  ASSERT_GT(litCount, 1000u);
  EXPECT_GT(lit, 0.0);
  EXPECT_LE(dark, 1e-4 * lit / static_cast<double>(litCount));
}

/// Queries for photons use the triangle, the place and the side of the texel.
TEST(IndirectLight, Queries_LieAtTheTexelsPlacesAndOnTheirSides) {
  IndirectScene light = builtinLight("shapes", 1024);
  for (CompiledMaterial& material : light.scene.materials) material.doubleSided = true;
  LightMapLayoutRequest map;
  map.texels = 1024;
  light.layout = makeLightMapLayout(light.source, light.scene, map);
  const auto queries = densityQueries(light.scene, light.layout.texels, 0.75, {});
  ASSERT_EQ(queries.size(), light.layout.texels.size());
  std::size_t backs = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const LightMapTexel& texel = light.layout.texels[i];
    const bool back = texel.face >= light.scene.triangleCount();
    const std::uint32_t triangle = texel.face - (back ? light.scene.triangleCount() : 0);
    const glm::uvec3& corners = light.scene.triangles[triangle];
    const glm::dvec3 a(light.scene.positions[corners.x]), b(light.scene.positions[corners.y]),
        c(light.scene.positions[corners.z]);
    const glm::dvec3 place = a + double(texel.b1) * (b - a) + double(texel.b2) * (c - a);
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a)) * (back ? -1.0 : 1.0);
    ASSERT_EQ(queries[i].triangle, triangle) << i;
    ASSERT_EQ(queries[i].radius, 0.75f) << i;
    for (int k = 0; k < 3; ++k) {
      ASSERT_NEAR(queries[i].position[k], place[k], 1e-4) << i;
      ASSERT_NEAR(queries[i].normal[k], normal[k], 1e-5) << i;
    }
    backs += back ? 1 : 0;
  }
  EXPECT_EQ(2 * backs, queries.size());
}

/// Another seed gives other bits.
TEST(IndirectLight, SameSeed_GivesTheSameBits_AnotherSeedOthers) {
  IndirectScene light = builtinLight("shapes", 256);
  light.request.photons = 2000;
  const std::vector<glm::vec3> first = light.gather(), again = light.gather();
  EXPECT_EQ(first, again);
  light.request.seed = 1;
  EXPECT_NE(first, light.gather());
}

/// The inside of a ball of albedo 0.5 around a lamp.
IndirectScene insideOfABall() {
  IndirectScene light;
  light.scene = sphere(24, 1.0f, {0.0f, 0.0f, 0.0f});
  for (glm::uvec3& t : light.scene.triangles) std::swap(t.y, t.z);
  for (glm::vec3& n : light.scene.normals) n = -n;
  light.scene.materials[0] = lambert(0.5f);
  light.scene.triangleFlat.assign(light.scene.triangles.size(), 1);
  Light lamp;
  lamp.type = LightType::Point;
  lamp.position = {0.3, 0.2, -0.4};
  lamp.intensity = glm::vec3(1.0f);
  light.lights = {lamp};
  LightMapLayoutRequest map;
  map.texels = 2048;
  light.layout = makeLightMapLayout(light.source, light.scene, map);
  light.request.photons = 200000;
  return light;
}

/// A lamp over a table over a floor. The table's black underside sees the lit part of the floor.
struct Table {
  static constexpr double height = 0.5, half = 0.5, lampHeight = 3.0, floorHalf = 4.0, albedo = 0.5;
  static constexpr float thickness = 1e-3f;

  static IndirectScene light() {
    IndirectScene light;
    light.scene = ground(1, static_cast<float>(floorHalf));
    const auto h = static_cast<float>(height), s = static_cast<float>(half);
    append(light.scene, box(1, {-s, h, -s}, {s, h + thickness, s}, false));
    light.scene.materials[0] = lambert(static_cast<float>(albedo));
    // The table reflects almost nothing, so that its underside sees only the lamp's light on the floor.
    light.scene.materials.push_back(lambert(1e-4f));
    for (std::size_t t = 2; t < light.scene.triangles.size(); ++t) light.scene.triangleMaterials[t] = 1;
    Light lamp;
    lamp.type = LightType::Point;
    lamp.position = {0.0, lampHeight, 0.0};
    lamp.intensity = glm::vec3(10.0f);
    light.lights = {lamp};
    LightMapLayoutRequest map;
    map.texels = 1u << 16;
    light.layout = makeLightMapLayout(light.source, light.scene, map);
    light.request.rays = 512;
    return light;
  }

  /// Irradiance at a place of the underside, by quadrature over the floor outside the shadow.
  static double expected(double x, double z) {
    constexpr int cells = 160;
    const double shadow = half * lampHeight / (lampHeight - height - double(thickness));
    const double side = 2.0 * floorHalf / cells;
    double sum = 0.0;
    for (int i = 0; i < cells; ++i)
      for (int k = 0; k < cells; ++k) {
        const double u = (i + 0.5) * side - floorHalf, v = (k + 0.5) * side - floorHalf;
        if (std::max(std::abs(u), std::abs(v)) < shadow) continue;
        const double toLamp = u * u + v * v + lampHeight * lampHeight;
        const double floor = 10.0 * lampHeight / (toLamp * std::sqrt(toLamp));
        const double squared = (u - x) * (u - x) + (v - z) * (v - z) + height * height;
        sum += albedo / pi * floor * height * height / (squared * squared) * side * side;
      }
    return sum;
  }
};

/// Root mean squared relative error over the table's underside.
double errorUnderTheTable(IndirectScene& table) {
  std::vector<LightMapTexel> places;
  for (const LightMapTexel& texel : table.layout.texels)
    if (receiverAt(table.scene, texel).normal[1] < -0.9f) places.push_back(texel);
  std::vector<glm::vec3> found;
  table.light([&](IndirectLight& light, Progress& progress) { found = light.gather(places, progress); });
  double squares = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const device::Receiver place = receiverAt(table.scene, places[i]);
    const double expected = Table::expected(double(place.position[0]), double(place.position[2]));
    squares += std::pow(double(found[i].x) / expected - 1.0, 2) / double(places.size());
  }
  return std::sqrt(squares);
}

TEST(IndirectLight, UndersideOfATable_SeesNoLightInTheTablesShadow) {
  IndirectScene table = Table::light();
  EXPECT_LT(errorUnderTheTable(table), 0.05);
  table.request.directByPhotons = true;
  EXPECT_GT(errorUnderTheTable(table), 0.1);
}

TEST(IndirectLight, ManyFaintEmitters_LeaveTheShadowOfALampDark) {
  IndirectScene table = Table::light();
  CompiledMaterial faint = lambert(0.0f);
  faint.emission = glm::vec3(1e-4f);
  table.scene.materials.push_back(faint);
  for (const float x : {-3.0f, -2.0f, 2.0f, 3.0f}) {
    append(table.scene, box(1, {x, 0.1f, 3.0f}, {x + 0.1f, 0.2f, 3.1f}, false));
    for (std::size_t t = table.scene.triangleCount() - 12; t < table.scene.triangles.size(); ++t)
      table.scene.triangleMaterials[t] = 2;
  }
  LightMapLayoutRequest map;
  map.texels = 1u << 16;
  table.layout = makeLightMapLayout(table.source, table.scene, map);
  EXPECT_LT(errorUnderTheTable(table), 0.05);
}

TEST(IndirectLight, UndersideOfATable_IsFoundByACacheOfFewPlacesAndByGuidedRays) {
  IndirectScene table = Table::light();
  table.request.gather = GatherChoice::Guided;
  EXPECT_LT(errorUnderTheTable(table), 0.05);
  table.request.gather = GatherChoice::Cache;
  EXPECT_LT(errorUnderTheTable(table), 0.05);
  std::size_t records = 0;
  table.light([&](IndirectLight& light, Progress& progress) {
    light.gather(table.layout.texels, progress);
    records = light.records();
  });
  EXPECT_LT(records, table.layout.texels.size() / 10);
}

/// Texels on the dark side of a wall may not use records from the lit side.
TEST(IndirectLight, SealedRooms_LetNothingThroughTheWallByTheCache) {
  IndirectScene light = builtinLight("rooms-sealed", 4096);
  const std::vector<glm::vec3> all = light.gather();
  light.request.gather = GatherChoice::Cache;
  const std::vector<glm::vec3> cached = light.gather();
  double dark = 0.0, lit = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    (all[i].x < 1e-6f ? dark : lit) = std::max<double>(all[i].x < 1e-6f ? dark : lit, cached[i].x);
  }
  EXPECT_GT(lit, 0.1);
  EXPECT_LT(dark, 1e-3 * lit);
}

TEST(IndirectLight, SameSeedOfOtherChoices_GivesTheSameBits_AnotherSeedOthers) {
  IndirectScene light = builtinLight("shapes", 256);
  light.request.photons = 2000;
  const std::vector<glm::vec3> all = light.gather();
  for (const GatherChoice choice : {GatherChoice::Cache, GatherChoice::Guided}) {
    light.request.gather = choice;
    light.request.gatherSeed = 0;
    const std::vector<glm::vec3> first = light.gather();
    EXPECT_NE(first, all);
    EXPECT_EQ(first, light.gather());
    light.request.gatherSeed = 1;
    EXPECT_NE(first, light.gather());
  }
}

/// A leaf of 4 x 4 m that transmits light and reflects none hangs 1 m above a floor in the sun. The floor
/// under its middle receives 0.8 of the sun times the leaf's form factor (Howell, B-3: four times that of a
/// quarter).
TEST(IndirectLight, FloorUnderALeaf_IsLitByWhatComesThrough) {
  IndirectScene light;
  light.scene = ground(4, 6.0f);
  append(light.scene, ground(1, 2.0f, 1.0f));
  light.scene.materials[0] = lambert(0.5f);
  light.scene.materials[1] = translucent(0.9f, 1.0f, 0.8f);
  Light sun;
  sun.type = LightType::Directional;
  sun.intensity = glm::vec3(3.0f);
  sun.direction = {0, -1, 0};
  light.lights = {sun};
  LightMapLayoutRequest map;
  map.texels = 4096;
  light.layout = makeLightMapLayout(light.source, light.scene, map);
  const double r = std::sqrt(5.0), factor = 4.0 / (2.0 * pi) * 2.0 * (2.0 / r) * std::atan(2.0 / r);
  const std::vector<glm::vec3> found = light.gather();
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const device::Receiver place = receiverAt(light.scene, light.layout.texels[i]);
    if (place.position[1] > 0.5f || std::hypot(place.position[0], place.position[2]) > 0.4f) continue;
    sum += double(found[i].x);
    ++count;
  }
  ASSERT_GT(count, 4.0);
  EXPECT_NEAR(sum / count, 3.0 * 0.8 * factor, 0.03 * 3.0 * 0.8 * factor);
}

/// Reflected light is even inside a sphere, wherever the lamp is: E = a / (1 - a) Phi / (4 pi r2).
TEST(IndirectLight, InsideOfAWhiteBall_IsEvenAndExact) {
  IndirectScene light = insideOfABall();
  double area = 0.0;
  for (std::uint32_t t = 0; t < light.scene.triangleCount(); ++t)
    area += 0.5 * glm::length(geometricNormal(light.scene, t));
  const double expected = 4.0 * pi / area;  // a / (1 - a) = 1.
  double sum = 0.0;
  const std::vector<glm::vec3> found = light.gather();
  for (const glm::vec3& e : found) {
    sum += static_cast<double>(e.x);
    EXPECT_NEAR(e.x, expected, 0.06 * expected);
  }
  EXPECT_NEAR(sum / static_cast<double>(found.size()), expected, 0.005 * expected);
}

/// With the lamp in the middle the whole sphere has one radiance: light comes evenly from a hemisphere, F = 2
/// E and V = E n.
TEST(IndirectLight, InsideOfABallAroundALamp_ComesEvenlyFromHalfASphere) {
  IndirectScene light = insideOfABall();
  light.lights[0].position = glm::dvec3(0.0);
  light.request.rays = 512;
  const std::vector<float> found = light.gatherIncident();
  const double constant = std::sqrt(1.0 / (4.0 * pi)), linear = std::sqrt(3.0 / (4.0 * pi));
  std::array<double, 5> error{};
  for (std::size_t i = 0; i < light.layout.texels.size(); ++i) {
    const device::Receiver receiver = receiverAt(light.scene, light.layout.texels[i]);
    const double e = static_cast<double>(found[15 * i]);
    const double expected[] = {e, 2.0 * e * constant, linear * e * receiver.normal[1],
                               linear * e * receiver.normal[2], linear * e * receiver.normal[0]};
    for (std::size_t k = 1; k < 5; ++k) {
      const double off = (static_cast<double>(found[15 * i + k]) - expected[k]) / e;
      EXPECT_NEAR(off, 0.0, 0.15) << k;
      error[k] += off / static_cast<double>(light.layout.texels.size());
    }
  }
  for (std::size_t k = 1; k < 5; ++k) EXPECT_NEAR(error[k], 0.0, 0.01) << k;
}

/// Even light of irradiance 1 from a hemisphere has coefficients 2 Y_lm(n) times the integral of P_l over
/// 0..1.
TEST(IndirectLight, InsideOfABallOfOrderFive_HasTheZonalFunctionsOfHalfASphere) {
  IndirectScene light = insideOfABall();
  light.lights[0].position = glm::dvec3(0.0);
  light.request.rays = 2048;
  const std::vector<float> found = light.gatherIncident(5), few = light.gatherIncident();
  constexpr std::array<double, 5> integrals = {1.0, 0.5, 0.0, -0.125, 0.0};
  std::array<double, 25> error{};
  for (std::size_t i = 0; i < light.layout.texels.size(); ++i) {
    const device::Receiver receiver = receiverAt(light.scene, light.layout.texels[i]);
    std::array<double, 25> functions{};
    sh::evaluate({receiver.normal[0], receiver.normal[1], receiver.normal[2]}, 5, functions);
    const double e = static_cast<double>(found[78 * i]);
    for (std::size_t k = 0; k < 5; ++k) ASSERT_EQ(found[78 * i + k], few[15 * i + k]);
    for (std::size_t k = 0; k < 25; ++k) {
      const auto l = static_cast<std::size_t>(std::sqrt(static_cast<double>(k)));
      const double off = static_cast<double>(found[78 * i + 1 + k]) / e - 2.0 * integrals[l] * functions[k];
      EXPECT_NEAR(off, 0.0, 0.3) << k;
      error[k] += off / static_cast<double>(light.layout.texels.size());
    }
  }
  for (std::size_t k = 0; k < 25; ++k) EXPECT_NEAR(error[k], 0.0, 0.01) << k;
}

/// A normal of a normal map, 30 degrees from the surface's own.
glm::dvec3 aside(const glm::dvec3& n) {
  const glm::dvec3 helper = std::abs(n.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  return glm::normalize(n + std::tan(pi / 6.0) * glm::normalize(glm::cross(helper, n)));
}

/// Direct and indirect light, [texel][channel][5].
std::vector<float> allIncident(IndirectScene& light) {
  std::vector<float> values = light.gatherIncident();
  std::vector<std::uint8_t> hidden(light.layout.texels.size(), 0);
  Tracer tracer(light.scene, sharedDevice());
  test::DirectLight(light.scene, tracer, 512, 0, 5).add(light.layout.texels, 5, values, hidden);
  return values;
}

/// Irradiance of normal-mapped surfaces from directional light against irradiance of surfaces that really
/// have those normals.
TEST(IndirectLight, TurnedNormals_GetWhatSurfacesTurnedSoDo) {
  for (const std::string name : {"cornell", "rooms"}) {
    IndirectScene flat = builtinLight(name, 4096), turned = builtinLight(name, 4096);
    flat.request.rays = turned.request.rays = 512;
    for (glm::vec3& n : turned.scene.normals) n = glm::vec3(aside(glm::dvec3(n)));
    const std::vector<float> values = allIncident(flat), expected = allIncident(turned);
    double error = 0.0, bandError = 0.0, unturned = 0.0, sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < flat.layout.texels.size(); ++i) {
      const device::Receiver own = receiverAt(flat.scene, flat.layout.texels[i]),
                             other = receiverAt(turned.scene, flat.layout.texels[i]);
      const glm::dvec3 n(own.normal[0], own.normal[1], own.normal[2]), m = aside(n);
      if (glm::distance(m, glm::dvec3(other.normal[0], other.normal[1], other.normal[2])) > 1e-3) continue;
      MapLight incident;
      for (std::size_t k = 0; k < 5; ++k)
        incident[k] = glm::dvec3(static_cast<double>(values[15 * i + 5 + k]));
      const double e = static_cast<double>(expected[15 * i + 5]), flatE = incident[0].x;
      // (F / 4 + V.m / 2) / (F / 4 + V.n / 2).
      const double quarter = 0.25 * std::sqrt(4.0 * pi) * incident[1].x,
                   half = 0.5 * std::sqrt(4.0 * pi / 3.0);
      const glm::dvec3 vector(incident[4].x, incident[2].x, incident[3].x);
      const double bands = quarter + half * glm::dot(vector, m),
                   ownBands = quarter + half * glm::dot(vector, n);
      const double byBands = ownBands > 0.0 ? flatE * std::max(bands, 0.0) / ownBands : 0.0;
      error += std::pow(mappedIrradiance(incident, n, m).x - e, 2.0);
      bandError += std::pow(byBands - e, 2.0);
      unturned += std::pow(flatE - e, 2.0);
      sum += e;
      ++count;
    }
    ASSERT_GT(count, 1000.0);
    EXPECT_LT(error, 0.15 * unturned) << name;
    EXPECT_LT(error, 0.7 * bandError) << name;
    const auto share = [&](double squares) { return std::to_string(std::sqrt(squares * count) / sum); };
    RecordProperty(
        name, share(error) + " of the mean, bands " + share(bandError) + ", unturned " + share(unturned));
  }
}

}  // namespace
}  // namespace prelight::test

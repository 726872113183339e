#include "gi/final_gather.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "base/directions.h"
#include "gi/irradiance_cache.h"
#include "photon/density_estimator.h"
#include "receivers/surface_sampler.h"
#include "support/devices.h"
#include "support/materials.h"
#include "support/scenes.h"

namespace prelight::test {
namespace {

using std::numbers::pi;

/// A black floor under a square of exit radiance 1 that looks down: y = 1, x 0.2..1.4, z -0.5..0.9.
struct UnderASquare {
  static constexpr std::array<std::array<double, 3>, 4> corners = {
      {{0.2, 1.0, -0.5}, {1.4, 1.0, -0.5}, {1.4, 1.0, 0.9}, {0.2, 1.0, 0.9}}};

  UnderASquare() {
    scene = ground(1, 4.0f);
    CompiledScene square = ground(1, 1.0f);
    for (std::size_t i = 0; i < square.positions.size(); ++i) {
      glm::vec3& p = square.positions[i];
      p = {0.8f + 0.6f * p.x, 1.0f, 0.2f + 0.7f * p.z};
    }
    for (glm::uvec3& t : square.triangles) std::swap(t.y, t.z);
    for (glm::vec3& n : square.normals) n = -n;
    append(scene, square);
    scene.materials[0] = lambert(0.0f);
    scene.materials[1] = lambert(1.0f);
    layout.width = layout.height = 1;
    layout.corners.assign(6 * std::size_t{scene.triangleCount()}, glm::vec2(0.5f));
    layout.chartOf.assign(2 * std::size_t{scene.triangleCount()}, 0);
    transport.emplace(LitScene{scene, noImages(), {}}, sharedDevice());
    map.emplace(transport->context(), layout);
    map->set(std::vector<glm::vec3>(1, glm::vec3(static_cast<float>(pi))));
  }

  /// Light vector by Lambert's formula: half the sum over edges of the edge's angle times its unit normal.
  static glm::dvec3 lightVector(const glm::dvec3& at) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& [ax, ay, az] = corners[i];
      const auto& [bx, by, bz] = corners[(i + 1) % 4];
      const glm::dvec3 a = glm::normalize(glm::dvec3(ax, ay, az) - at),
                       b = glm::normalize(glm::dvec3(bx, by, bz) - at);
      sum += 0.5 * std::acos(glm::dot(a, b)) * glm::normalize(glm::cross(a, b));
    }
    return sum.y < 0.0 ? -sum : sum;
  }

  /// Receivers at one place of the floor.
  std::vector<device::Receiver> receivers(std::uint32_t count, const glm::vec3& normal,
                                          float x = 0.1f) const {
    std::vector<device::Receiver> all;
    for (std::uint32_t i = 0; i < count; ++i) {
      device::Receiver receiver = receiverAt(scene, {0, 0.2f, 0.35f, 1.0f}, Side::Front);
      receiver.position[0] = x;
      receiver.position[2] = 0.0f;
      for (int k = 0; k < 3; ++k) receiver.normal[k] = normal[k];
      receiver.seed = 977 * i + 5;
      receiver.firstSample = 0;
      all.push_back(receiver);
    }
    return all;
  }

  FinalGather gatherer(std::uint32_t rays) {
    GatherRequest request;
    request.raysPerReceiver = rays;
    return FinalGather(*transport, *map, request);
  }

  CompiledScene scene;
  LightMapLayout layout;
  std::optional<TransportScene> transport;
  std::optional<IrradianceMap> map;
};

glm::dvec3 placeOf(const device::Receiver& r) { return {r.position[0], r.position[1], r.position[2]}; }

/// Mean over the records.
device::GatherRecord meanOf(const std::vector<device::GatherRecord>& records) {
  device::GatherRecord mean{};
  const float share = 1.0f / static_cast<float>(records.size());
  for (const device::GatherRecord& r : records) {
    mean.closeness += share * r.closeness;
    mean.irradiance[0] += share * r.irradiance[0];
    for (int k = 0; k < 3; ++k) {
      mean.translation[0][k] += share * r.translation[0][k];
      mean.rotation[0][k] += share * r.rotation[0][k];
    }
  }
  return mean;
}

device::GatherRecord recordUnderTheSquare(UnderASquare& room, std::uint32_t rays) {
  FinalGather gather = room.gatherer(rays);
  RecordGather pattern(gather);
  Progress progress;
  gather.gather(room.receivers(512, {0.0f, 1.0f, 0.0f}), pattern, progress);
  return meanOf(pattern.take());
}

/// Edges are assumed where two strata meet, up to half a stratum away from the true edge. With 8 x 32 strata
/// their squared sine is off by a sixteenth, and the translation gradient by about as much.
TEST(GatherRecords, UnderASquare_HaveItsLightAndBothGradients) {
  UnderASquare room;
  const glm::dvec3 n(0.0, 1.0, 0.0), at = placeOf(room.receivers(1, glm::vec3(n))[0]);
  const device::GatherRecord found = recordUnderTheSquare(room, 256), few = recordUnderTheSquare(room, 16);
  const glm::dvec3 light = UnderASquare::lightVector(at);
  EXPECT_NEAR(found.irradiance[0], light.y, 0.005 * light.y);
  constexpr double step = 1e-4;
  const auto slope = [&](const glm::dvec3& way) {
    return (UnderASquare::lightVector(at + step * way).y - UnderASquare::lightVector(at - step * way).y) /
           (2.0 * step);
  };
  const glm::dvec3 translation(slope({1, 0, 0}), 0.0, slope({0, 0, 1})), rotation = glm::cross(n, light);
  const auto vectorOf = [](const float(&v)[3]) { return glm::dvec3(v[0], v[1], v[2]); };
  const double off = glm::distance(vectorOf(found.translation[0]), translation) / glm::length(translation);
  EXPECT_LT(off, 0.1);
  EXPECT_LT(off, 0.5 * glm::distance(vectorOf(few.translation[0]), translation) / glm::length(translation));
  EXPECT_LT(glm::distance(vectorOf(found.rotation[0]), rotation), 0.03 * glm::length(rotation));
}

/// Above a floor's middle there is only a wide ceiling at height 1: 1 / distance is the cosine, with a mean
/// of 2/3.
TEST(GatherRecords, UnderAWideCeiling_KnowTheHarmonicMeanDistance) {
  UnderASquare room;
  room.scene = ground(1, 500.0f);
  CompiledScene ceiling = ground(1, 500.0f, 1.0f);
  for (glm::uvec3& t : ceiling.triangles) std::swap(t.y, t.z);
  append(room.scene, ceiling);
  TransportScene transport({room.scene, noImages(), {}}, sharedDevice());
  IrradianceMap map(transport.context(), room.layout);
  map.set(std::vector<glm::vec3>(1, glm::vec3(1.0f)));
  GatherRequest request;
  FinalGather gather(transport, map, request);
  device::Receiver receiver = receiverAt(room.scene, {0, 0.01f, 0.49f, 1.0f}, Side::Front);
  receiver.seed = 3;
  receiver.firstSample = 0;
  RecordGather pattern(gather);
  Progress progress;
  gather.gather(std::vector{receiver}, pattern, progress);
  const device::GatherRecord found = pattern.take().at(0);
  EXPECT_NEAR(found.closeness, 2.0 / 3.0, 0.01);
  EXPECT_NEAR(found.nearest, 1.0, 0.01);
}

struct Spread {
  double mean = 0.0, deviation = 0.0;
};

Spread spreadOf(const std::vector<glm::vec3>& values) {
  Spread spread;
  for (const glm::vec3& v : values)
    spread.mean += static_cast<double>(v.x) / static_cast<double>(values.size());
  for (const glm::vec3& v : values)
    spread.deviation +=
        std::pow(static_cast<double>(v.x) - spread.mean, 2) / static_cast<double>(values.size());
  spread.deviation = std::sqrt(spread.deviation);
  return spread;
}

std::vector<glm::vec3> gatherGuided(FinalGather& gather, const std::vector<device::Receiver>& receivers,
                                    const std::vector<float>& guide) {
  std::vector<float> guides;
  for (std::size_t i = 0; i < receivers.size(); ++i) guides.insert(guides.end(), guide.begin(), guide.end());
  GuidedGather pattern(gather, guides, receivers.size());
  Progress progress;
  gather.gather(receivers, pattern, progress);
  return pattern.irradiance();
}

TEST(GuidedGather, ArbitraryGuides_LeaveTheMeanAsItIs) {
  UnderASquare room;
  const glm::vec3 n = glm::normalize(glm::vec3(0.2f, 1.0f, -0.1f));
  const auto receivers = room.receivers(4000, n);
  FinalGather gather = room.gatherer(32);
  const double expected = glm::dot(UnderASquare::lightVector(placeOf(receivers[0])), glm::dvec3(n));
  for (const std::size_t favoured : {0u, 9u, 27u, 36u, 63u}) {
    std::vector<float> guide(PRELIGHT_GUIDE_CELLS);
    for (std::size_t k = 0; k < guide.size(); ++k) guide[k] = 0.3f + 0.01f * static_cast<float>(k * k % 7);
    guide[favoured] = 20.0f;
    const float mean = std::accumulate(guide.begin(), guide.end(), 0.0f) / static_cast<float>(guide.size());
    for (float& density : guide) density /= mean;
    const Spread found = spreadOf(gatherGuided(gather, receivers, guide));
    EXPECT_GT(found.deviation, 0.0);
    EXPECT_NEAR(found.mean, expected, 4.0 * found.deviation / std::sqrt(double(receivers.size())))
        << favoured;
  }
}

/// A guide from photons that arrive from points of the square itself.
std::vector<float> guideFromTheSquare(const UnderASquare& room, const device::Receiver& receiver) {
  const DensitySurface surface =
      makeDensitySurface(room.scene, makeSurfaceRegions(room.scene, usualCreaseAngle));
  std::vector<device::Photon> photons;
  const glm::dvec3 at = placeOf(receiver);
  for (int i = 0; i < 400; ++i) {
    const glm::dvec3 from(0.2 + 1.2 * (i % 20 + 0.5) / 20.0, 1.0, -0.5 + 1.4 * (i / 20 + 0.5) / 20.0);
    device::Photon photon{};
    for (int k = 0; k < 3; ++k) {
      photon.position[k] =
          static_cast<float>(at[k]) + (k == 1 ? 0.0f : 0.001f * static_cast<float>(i % (7 + k)));
      photon.power[k] = 1.0f;
    }
    photon.direction = packDirection(glm::normalize(from - at));
    photons.push_back(photon);
  }
  DensityOptions options;
  options.nearest = 390;
  DensityEstimator estimator(surface, options, sharedDevice());
  estimator.setPhotons(makePhotonMaps(photons, surface));
  device::DensityQuery query{};
  for (int k = 0; k < 3; ++k) {
    query.position[k] = receiver.position[k];
    query.normal[k] = receiver.normal[k];
  }
  query.radius = 1.0f;
  return estimator.guides(std::vector{query});
}

TEST(GuidedGather, GuidesOfPhotonsFromTheLight_LessenTheNoise) {
  UnderASquare room;
  const auto receivers =
      room.receivers(2000, {0.0f, 1.0f, 0.0f}, -1.5f);  // Sees the square in a fiftieth of all directions.
  const std::vector<float> guide = guideFromTheSquare(room, receivers[0]);
  double sum = 0.0;
  for (const float density : guide) {
    EXPECT_GE(density, 0.5f);
    sum += static_cast<double>(density);
  }
  EXPECT_NEAR(sum, 64.0, 1e-3);
  FinalGather gather = room.gatherer(32);
  Progress progress;
  const Spread plain = spreadOf(gather.gather(receivers, progress));
  const Spread guided = spreadOf(gatherGuided(gather, receivers, guide));
  const double expected = UnderASquare::lightVector(placeOf(receivers[0])).y;
  EXPECT_NEAR(guided.mean, expected, 4.0 * guided.deviation / std::sqrt(double(receivers.size())));
  EXPECT_LT(guided.deviation, 0.5 * plain.deviation);
}

TEST(GuidedGather, EvenGuides_GiveWhatUnguidedRaysDo) {
  UnderASquare room;
  const auto receivers = room.receivers(16, {0.0f, 1.0f, 0.0f});
  FinalGather gather = room.gatherer(128);
  Progress progress;
  const std::vector<glm::vec3> plain = gather.gather(receivers, progress);
  const std::vector<glm::vec3> guided =
      gatherGuided(gather, receivers, std::vector<float>(PRELIGHT_GUIDE_CELLS, 1.0f));
  for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_NEAR(guided[i].x, plain[i].x, 0.05f * plain[i].x);
}

/// The square fills so little of the view that one of eight receivers meets it, most with one ray of 64.
TEST(BoundedGather, SquareThatFewRaysMeet_IsExcessAndTheSumStays) {
  UnderASquare room;
  FinalGather gather = room.gatherer(64);
  const std::vector<device::Receiver> receivers = room.receivers(256, {0.0f, 1.0f, 0.0f}, -3.0f);
  Progress progress;
  const std::vector<glm::vec3> whole = gather.gather(receivers, progress);
  BoundedGather bounded(gather, receivers.size());
  gather.gather(receivers, bounded, progress);
  std::size_t meeting = 0;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const BoundedIrradiance& found = bounded.irradiance()[i];
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(found.bounded[c] + found.excess[c], whole[i][c], 1e-5f * whole[i][c] + 1e-7f);
    if (whole[i].x > 0.0f) {
      EXPECT_GT(found.excess.x, 0.5f * whole[i].x);
      ++meeting;
    }
  }
  EXPECT_GT(meeting, receivers.size() / 16);
  EXPECT_LT(meeting, receivers.size() / 4);
}

/// Under the square every ray brings about as much as the others or nothing.
TEST(BoundedGather, SquareThatManyRaysMeet_IsNoExcess) {
  UnderASquare room;
  FinalGather gather = room.gatherer(64);
  const std::vector<device::Receiver> receivers = room.receivers(64, {0.0f, 1.0f, 0.0f}, 0.8f);
  Progress progress;
  BoundedGather bounded(gather, receivers.size());
  gather.gather(receivers, bounded, progress);
  for (const BoundedIrradiance& found : bounded.irradiance()) {
    EXPECT_GT(found.bounded.x, 0.0f);
    EXPECT_EQ(found.excess.x, 0.0f);
  }
}

}  // namespace
}  // namespace prelight::test

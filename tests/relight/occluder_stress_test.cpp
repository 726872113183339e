// Light from a million places through vector occluders on the device: on occluders, on receivers, along
// vectors, far away, inside glass.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "occluders/wave_table.h"
#include "support/devices.h"
#include "support/occluders.h"
#include "support/scenes.h"
#include "techniques/vector_occluders/occluder_relighter.h"

namespace prelight {
namespace {

using test::MadeOccluders;

constexpr std::size_t stressedVertices = 20;
constexpr std::size_t lightsARound = 1000;
constexpr double leastDistance = 0.01;

const OccluderEye stressEye{{1.0, 1.0, 1.0}, true};

class Places {
 public:
  explicit Places(const MadeOccluders& made) : made_(made), width_(made.transfer.stored.size()) {}

  glm::dvec3 at(std::size_t number) {
    const glm::dvec3 anywhere = 4.0 * std::abs(normal_(random_)) * glm::dvec3(test::randomDirection(random_));
    const std::size_t v = random_() % made_.positions.size();
    const glm::dvec3 receiver(made_.positions[v]);
    const std::size_t records = made_.transfer.recordCount();
    const glm::vec4* record = made_.transfer.vectors.data() + random_() % records * width_;
    const glm::dvec3 occluder(record[0]);
    switch (number % 8) {
      case 0:
        return 1e6 * anywhere;
      case 1:
        return occluder;
      case 2:
        return receiver;
      case 3:
        return receiver + 3.0 * glm::dvec3(record[1]) / std::max(1e-9, double(record[1].w));
      case 4:
        return receiver + 3.0 * glm::dvec3(record[2]) / std::max(1e-9, double(record[2].w));
      case 5:
        return occluder + 1e-6 * anywhere;
      case 6:
        return glm::mix(receiver, occluder, 0.5 + unit_(random_));  // In front of, within and behind it.
      default:
        return anywhere;
    }
  }

 private:
  const MadeOccluders& made_;
  std::size_t width_;
  std::mt19937 random_{17};
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

OccluderShading shadingOfRound(std::size_t round) {
  OccluderShading shading;
  shading.formula = round % 2 == 0 ? OccluderFormula::Soft : OccluderFormula::Thesis;
  shading.receiver = round % 3 == 0 ? DiffuseReceiver::OrenNayar : DiffuseReceiver::Lambert;
  shading.shadowStrength = round % 5 == 0 ? 100.0 : 2.0;
  shading.causticStrength = round % 7 == 0 ? 100.0 : 1.0;
  shading.specularExponent = round % 4 == 0 ? 1000.0 : 10.0;
  if (round % 11 == 0) shading.bleeding = -100.0;
  shading.mirrors = round % 9 < 4 ? MirrorFormula::Thesis : MirrorFormula::Lobe;
  if (round % 6 == 0)
    shading.effects = {10.0, 0.5, 1.0, 0.01 * static_cast<double>(round % 100), round % 12 == 0 ? 10.0 : 0.0};
  return shading;
}

/// Lights of 1 W/sr give at most 1 / leastDistance^2; the largest values of the terms bound the receiver's
/// response.
constexpr double mostIrradiance = 2.0 / (leastDistance * leastDistance);
constexpr double mostDiffuse = 1e5 * mostIrradiance;
constexpr double mostSpecular = 1e8 * mostIrradiance;

bool isGood(double value, double most) { return value >= 0.0 && value <= most; }  // False for NaN.

std::size_t countBad(const device::LitVertex& lit, double lights) {
  std::size_t bad = 0;
  for (int c = 0; c < 3; ++c) {
    bad += isGood(lit.diffuse[c], lights * mostDiffuse) ? 0 : 1;
    bad += isGood(lit.specular[c], lights * mostSpecular) ? 0 : 1;
    bad += isGood(lit.reflected[c], lights * mostDiffuse) ? 0 : 1;
  }
  return bad + (isGood(lit.highlight, 64.0) ? 0 : 1);
}

std::size_t countBadInReference(const MadeOccluders& made, const device::OccluderLight& light, std::size_t v,
                                const OccluderShading& shading) {
  const OccluderReceiver receiver = test::receiverOf(made, v, stressEye.position);
  const LightAt source = [&](const glm::dvec3& point) { return incidentFrom(light, point); };
  const OccludedLight lit = litThroughOccluders(made.transfer, receiver, std::span(&source, 1), shading);
  std::size_t bad = 0;
  for (int c = 0; c < 3; ++c) {
    bad += isGood(lit.diffuse[c], mostDiffuse) ? 0 : 1;
    bad += isGood(lit.specular[c], mostSpecular) ? 0 : 1;
    bad += isGood(lit.reflected[c], mostDiffuse) ? 0 : 1;
  }
  return bad;
}

// Sums over a thousand lights each show NaN and unbounded values. One light in a hundred is checked alone,
// which shows negative values.
TEST(OccluderStress, MillionLightPlaces_StayFiniteBoundedAndNotNegative) {
  const MadeOccluders made = test::makeOccluders(stressedVertices, test::everyOptionalVector(), 1);
  OccluderRelighter relighter(test::sharedDevice().context(), made.transfer,
                              {made.positions, made.normals, glm::dvec3(0.0), made.gloss});
  Places places(made);
  std::size_t bad = 0, badReference = 0;
  for (std::size_t round = 0; round < 1000; ++round) {
    std::vector<device::OccluderLight> lights;
    for (std::size_t i = 0; i < lightsARound; ++i)
      lights.push_back(occluderPointLight(places.at(i), glm::dvec3(1.0), leastDistance));
    const OccluderShading shading = shadingOfRound(round);
    for (const device::LitVertex& lit : relighter.relight(lights, shading, stressEye))
      bad += countBad(lit, lightsARound);
    for (std::size_t i = 0; i < 10; ++i) {
      const device::OccluderLight& light = lights[(round * 37 + i * 101) % lightsARound];
      for (const device::LitVertex& lit : relighter.relight(std::span(&light, 1), shading, stressEye))
        bad += countBad(lit, 1);
      badReference += countBadInReference(made, light, (round + i) % stressedVertices, shading);
    }
  }
  EXPECT_EQ(bad, 0u);
  EXPECT_EQ(badReference, 0u);
}

TEST(OccluderEffects, ZeroAmplitude_ChangesNothing_AndPeriodsCloseExactly) {
  const MadeOccluders made = test::makeOccluders(200, test::everyOptionalVector(), 2);
  OccluderRelighter relighter(test::sharedDevice().context(), made.transfer,
                              {made.positions, made.normals, glm::dvec3(0.0), made.gloss});
  const auto lights = test::makeLights(8, 3);
  const auto at = [&](double waves, double fire, double seconds) {
    OccluderShading shading;
    shading.effects = {waves, 1.5, fire, effectMoment(seconds)};
    return relighter.relight(lights, shading, stressEye);
  };
  const auto still = at(0.0, 0.0, 0.0), zero = at(0.0, 0.0, 3.3);
  const auto once = at(0.4, 0.7, 1.25), again = at(0.4, 0.7, 1.25 + 3.0 * effectPeriod),
             later = at(0.4, 0.7, 2.5);
  double changed = 0.0;
  for (std::size_t v = 0; v < still.size(); ++v) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(still[v].diffuse[c], zero[v].diffuse[c]);
      EXPECT_EQ(once[v].diffuse[c], again[v].diffuse[c]);
      changed = std::max(changed, double(std::abs(once[v].diffuse[c] - later[v].diffuse[c])));
    }
  }
  EXPECT_GT(changed, 0.01);
}

TEST(OccluderEffects, Drain_TakesColourAwayAndStopsAtBlack) {
  const MadeOccluders made = test::makeOccluders(200, {}, 4);
  OccluderRelighter relighter(test::sharedDevice().context(), made.transfer,
                              {made.positions, made.normals, glm::dvec3(0.0), {}});
  const auto lights = test::makeLights(8, 5);
  const auto with = [&](double bleeding) {
    OccluderShading shading;
    shading.bleeding = bleeding;
    return relighter.relight(lights, shading, stressEye);
  };
  const auto plain = with(0.0), drained = with(-1.0), empty = with(-1e6);
  std::size_t darker = 0, black = 0;
  for (std::size_t v = 0; v < plain.size(); ++v) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(drained[v].diffuse[c], 0.0f);
      EXPECT_LE(drained[v].diffuse[c], plain[v].diffuse[c]);
      darker += drained[v].diffuse[c] < plain[v].diffuse[c] ? 1 : 0;
      black += empty[v].diffuse[c] == 0.0f && plain[v].diffuse[c] > 0.0f ? 1 : 0;
    }
  }
  EXPECT_GT(darker, 50u);
  EXPECT_GT(black, 50u);
}

}  // namespace
}  // namespace prelight

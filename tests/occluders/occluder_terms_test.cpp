// Terms of vector occluders against closed forms, and the energy that they carry.
#include "occluders/occluder_terms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <span>
#include <utility>

#include "occluders/wave_table.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using std::numbers::pi;

/// Integral over all directions, as a sum over points of a Fibonacci spiral with equal weights.
double overSphere(const std::function<double(const glm::dvec3&)>& value, int count = 200000) {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, angle = pi * (3.0 - std::sqrt(5.0)) * i;
    const double r = std::sqrt(1.0 - z * z);
    sum += value({r * std::cos(angle), r * std::sin(angle), z});
  }
  return sum * 4.0 * pi / count;
}

/// A clear ball in one direction, whose caustic has a mean resultant length.
OccluderRow clearBall(double formFactor, double resultant) {
  OccluderRow row;
  row.hasCaustic = row.hasTransmissive = true;
  OccluderRecord record;
  const glm::dvec3 way = glm::normalize(glm::dvec3(1, 2, 2));
  record.position = glm::dvec4(2.0 * way, 2.0);
  record.occlusion = glm::dvec4(0.95 * formFactor * way, formFactor);
  record.caustic = glm::dvec4(resultant * 0.8 * formFactor * way, 0.8 * formFactor);
  record.transmissive = glm::dvec4(0.7, 0.5, 0.1, 0.0);
  row.records = {record};
  return row;
}

OccluderReceiver upwards() {
  OccluderReceiver receiver;
  receiver.normal = {0, 0, 1};
  receiver.toEye = glm::normalize(glm::dvec3(1, 0, 1));
  return receiver;
}

TEST(OccluderTerms, Caustic_CarriesTheLightOfTheRaysAndNoMore) {
  for (const double resultant : {0.0, 0.3, 0.7, 0.95, 0.999, 1.0}) {
    const OccluderRow row = clearBall(0.2, resultant);
    for (const double strength : {1.0, 0.5}) {
      OccluderShading shading;
      shading.causticStrength = strength;
      for (int c = 0; c < 3; ++c) {
        const double carried = overSphere([&](const glm::dvec3& toLight) {
          return causticLight(row, row.records[0], {glm::dvec3(1.0), toLight}, shading)[c];
        });
        EXPECT_NEAR(carried, strength * 0.2 * row.records[0].transmissive[c], 1e-5) << resultant;
      }
    }
  }
}

// The concentration for a mean resultant length is an approximation: Banerjee et al. give it within a few
// percent. It is at most 100.
TEST(OccluderTerms, Caustic_IsAsWideAsTheRays) {
  for (const double resultant : {0.1, 0.4, 0.8, 0.95, 0.98}) {
    const OccluderRow row = clearBall(0.2, resultant);
    const glm::dvec3 mean = glm::normalize(glm::dvec3(row.records[0].caustic));
    const double got = overSphere([&](const glm::dvec3& toLight) {
      return glm::dot(mean, toLight) * causticDensity(row.records[0], toLight);
    });
    EXPECT_NEAR(got, resultant, 0.02);
  }
  const OccluderRow pointed = clearBall(0.2, 1.0);
  EXPECT_NEAR(causticDensity(pointed.records[0], glm::normalize(glm::dvec3(1, 2, 2))), 100.0 / (2.0 * pi),
              1e-9);
}

TEST(OccluderTerms, ShadowOfGlass_IsItsOpacity_AndWhatIsBentIsNotStraightToo) {
  OccluderRow row = clearBall(0.2, 0.9);
  OccluderShading shading;
  EXPECT_EQ(shadowOpacity(row, row.records[0], shading), glm::dvec3(1.0));
  shading.causticStrength = 0.25;
  EXPECT_NEAR(shadowOpacity(row, row.records[0], shading).y, 1.0 - 0.75 * 0.5, 1e-12);
  row.hasCaustic = false;
  EXPECT_NEAR(shadowOpacity(row, row.records[0], shading).y, 0.5, 1e-12);
  row.hasTransmissive = false;
  EXPECT_EQ(shadowOpacity(row, row.records[0], shading), glm::dvec3(1.0));
}

// Without a bound, Eq. 7.3 is infinite along the caustic's direction, and carries N F / (1 - N F) of a sky.
TEST(OccluderTerms, ThesisCaustic_IsBoundedByEnergy) {
  OccluderShading shading;
  shading.formula = OccluderFormula::Thesis;
  shading.shadowStrength = 0.0;
  for (const double strength : {0.5, 1.0, 2.0, 20.0}) {
    shading.causticStrength = strength;
    const OccluderRow row = clearBall(0.25, 0.9);
    OccluderRecord record = row.records[0];
    record.transmissive = glm::dvec4(1.0);
    const glm::dvec3 way = glm::normalize(glm::dvec3(record.caustic));
    const double excess = overSphere([&](const glm::dvec3& toLight) {
      return (thesisFactor(row, record, toLight, shading).x - 1.0) * std::max(glm::dot(toLight, way), 0.0) /
             pi;
    });
    EXPECT_LE(excess, record.caustic.w * 1.001);
    EXPECT_GT(excess, 0.4 * std::min(strength, 1.0) * record.caustic.w);
    const double peak = thesisFactor(row, record, way, shading).x;
    EXPECT_GT(peak, 1.5);
    EXPECT_LE(peak, 32.0);
  }
}

TEST(OccluderTerms, ThesisFactor_OfOpaqueAndOfClear) {
  OccluderRow row = clearBall(0.25, 0.9);
  OccluderShading shading;
  shading.formula = OccluderFormula::Thesis;
  const glm::dvec3 aside = glm::normalize(glm::dvec3(-2, 1, 0.01));
  EXPECT_NEAR(thesisFactor(row, row.records[0], aside, shading).x, 1.0, 1e-3);  // Nothing is in the way.
  row.hasCaustic = false;
  const glm::dvec3 way = glm::normalize(glm::dvec3(1, 2, 2));
  EXPECT_NEAR(thesisFactor(row, row.records[0], way, shading).y, 0.5, 1e-9);  // The clear share.
}

// Under an even sky a flat mirror contributes its reflectance x its share of the sky, whatever the exponent.
TEST(OccluderTerms, MirroredLight_IntegratesToReflectanceTimesFormFactor) {
  OccluderReceiver receiver = upwards();
  for (const double alike : {1.0, 0.8}) {
    OccluderRecord record = clearBall(0.2, 0.9).records[0];
    record.mirrorNormal = glm::dvec4(glm::dvec3(0, 0, -1) * 0.15 * alike, 0.15);
    record.mirrorColor = glm::dvec4(0.9, 0.6, 0.3, 0.0);
    OccluderShading shading;
    shading.specularExponent = 50.0;
    const double sum = overSphere([&](const glm::dvec3& toLight) {
      return mirroredLight(receiver, record, {glm::dvec3(1.0), toLight}, shading).y;
    });
    EXPECT_NEAR(sum, 0.6 * 0.15, 1e-5);
  }
}

TEST(OccluderTerms, MirroredLight_ComesFromWhereTheMirrorSays) {
  OccluderRecord record = clearBall(0.2, 0.9).records[0];
  record.occlusion = glm::dvec4(0.2 * glm::normalize(glm::dvec3(1, 2, 2)), 0.2);
  record.mirrorNormal = glm::dvec4(0, 0, -0.2, 0.2);
  record.mirrorColor = glm::dvec4(1.0);
  OccluderShading shading;
  const auto from = [&](const glm::dvec3& direction) {
    return mirroredLight(upwards(), record, {glm::dvec3(1.0), glm::normalize(direction)}, shading).x;
  };
  // A ceiling mirrors light that comes up from below it.
  EXPECT_NEAR(from({1, 2, -2}), 0.2 * 101.0 / (2.0 * pi), 1e-9);
  EXPECT_LT(from({1, 2, 2}), 1e-6);
}

/// A mirror on the ceiling straight above a receiver that mirrors as well; the eye looks down at the
/// receiver.
OccluderRecord mirrorAbove() {
  OccluderRecord record;
  record.position = glm::dvec4(0, 0, 2, 2);
  record.occlusion = glm::dvec4(0, 0, 0.3, 0.3);
  record.mirrorNormal = glm::dvec4(0, 0, -0.25, 0.3);
  record.mirrorColor = glm::dvec4(0.5, 0.25, 1.0, 0.0);
  return record;
}

// Listing A.2: (weight x cosine)^exponent, and (cosine of the view direction^(1 - weight) x cosine)^exponent.
TEST(OccluderTerms, ThesisMirrors_ArePowersOfTheListing) {
  OccluderShading shading;
  shading.mirrors = MirrorFormula::Thesis;
  shading.specularExponent = 3.0;
  OccluderReceiver receiver = upwards();
  receiver.f0 = glm::dvec3(0.8);
  const double angle = 0.4;  // Angle of eye and light from the vertical.
  receiver.toEye = {std::sin(angle), 0, std::cos(angle)};
  const glm::dvec3 below(std::sin(angle), 0, -std::cos(angle));
  const IncidentLight light{glm::dvec3(2.0), below};
  const glm::dvec3 sent = glm::dvec3(0.5, 0.25, 1.0) * 2.0 / pi;
  const glm::dvec3 diffuse = mirroredLight(receiver, mirrorAbove(), light, shading);
  const glm::dvec3 again = mirroredAgain(receiver, mirrorAbove(), light, shading);
  // The reflected view ray goes to (-sin, 0, cos), and beyond the mirror to (-sin, 0, -cos).
  const double beyond = std::cos(2.0 * angle), looks = std::pow(std::cos(angle), 0.75);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(diffuse[c], std::pow(0.25 * std::cos(angle), 3.0) * sent[c], 1e-12);
    EXPECT_NEAR(again[c], std::pow(looks * beyond, 3.0) * 0.8 * sent[c], 1e-12);
  }
  shading.specularFromSpecular = 2.0;
  EXPECT_NEAR(mirroredAgain(receiver, mirrorAbove(), light, shading).x, 2.0 * again.x, 1e-12);
}

TEST(OccluderTerms, ThesisMirrors_OfNothingThatMirrors_AreDark) {
  OccluderShading shading;
  shading.mirrors = MirrorFormula::Thesis;
  OccluderReceiver receiver = upwards();
  receiver.f0 = glm::dvec3(1.0);
  OccluderRecord record = mirrorAbove();
  record.mirrorNormal = glm::dvec4(0.0);
  const IncidentLight light{glm::dvec3(1.0), glm::normalize(glm::dvec3(-1, 0, 1))};
  EXPECT_EQ(mirroredLight(receiver, record, light, shading), glm::dvec3(0.0));
  EXPECT_EQ(mirroredAgain(receiver, record, light, shading), glm::dvec3(0.0));
}

TEST(OccluderTerms, MirroredAgain_IsAtMostWhatTheMirrorSends) {
  OccluderReceiver receiver = upwards();
  receiver.f0 = glm::dvec3(1.0);
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    OccluderRecord record;
    const glm::dvec3 way(test::randomDirection(random));
    record.occlusion = glm::dvec4(0.3 * way, 0.4);
    record.mirrorNormal = glm::dvec4(0.2 * glm::dvec3(test::randomDirection(random)), 0.25);
    record.mirrorColor = glm::dvec4(1.0);
    receiver.roughness = 0.05 + 0.005 * i;
    const OccluderShading shading;
    // A mirror shows at most 1 of an even sky of 1.
    const double sum = overSphere(
        [&](const glm::dvec3& toLight) {
          return mirroredAgain(receiver, record, {glm::dvec3(1.0), toLight}, shading).x;
        },
        5000);
    EXPECT_LE(sum, 1.01);
    EXPECT_GE(sum, 0.0);
  }
}

TEST(OccluderTerms, RoughDiffuse_WithoutRoughnessIsLambert_AndNeverReflectsMore) {
  OccluderReceiver receiver = upwards();
  receiver.roughness = 0.0;
  EXPECT_NEAR(roughDiffuse(receiver, glm::normalize(glm::dvec3(1, 1, 1))), 1.0, 1e-12);
  for (const double roughness : {0.3, 1.0}) {
    receiver.roughness = roughness;
    for (const double slant : {0.01, 0.5, 1.2, 1.55}) {
      receiver.toEye = {std::sin(slant), 0.0, std::cos(slant)};
      const double albedo = overSphere([&](const glm::dvec3& toLight) {
        return toLight.z > 0.0 ? roughDiffuse(receiver, toLight) * toLight.z / pi : 0.0;
      });
      EXPECT_LE(albedo, 1.001);
      EXPECT_GE(albedo, 0.6);
    }
    // The surface is brighter where the light comes from behind the eye.
    receiver.toEye = glm::normalize(glm::dvec3(1, 0, 0.5));
    EXPECT_GT(roughDiffuse(receiver, glm::normalize(glm::dvec3(1, 0, 0.5))),
              roughDiffuse(receiver, glm::normalize(glm::dvec3(-1, 0, 0.5))));
  }
}

TEST(OccluderTerms, GlossyBrdf_ReflectsAtMostAll) {
  OccluderReceiver receiver = upwards();
  receiver.f0 = glm::dvec3(1.0);
  const auto albedo = [&](double roughness) {
    receiver.roughness = roughness;
    return overSphere([&](const glm::dvec3& toLight) {
      return toLight.z > 0.0 ? glossyBrdf(receiver, toLight).x * toLight.z : 0.0;
    });
  };
  EXPECT_NEAR(albedo(0.3), 1.0, 0.02);  // A smooth surface loses nothing.
  EXPECT_LE(albedo(0.6), 1.0);
  // At roughness 1 the distribution is 1 / pi, and the integral is that of x / (x + c) with c the cosine of
  // the eye.
  const double c = receiver.toEye.z;
  EXPECT_NEAR(albedo(1.0), 1.0 - c * std::log((1.0 + c) / c), 1e-4);
}

// Waves offset the direction sideways in proportion to their height, and so does the tangent of the angle.
TEST(BentRecord, Waves_BendByAnAngleWhoseTangentIsTheirHeight) {
  const OccluderRecord record = clearBall(0.2, 0.9).records[0];
  OccluderEffects effects;
  const auto tangentAt = [&](const glm::dvec3& place, double waves) {
    OccluderReceiver receiver = upwards();
    receiver.position = place;
    effects.waves = waves;
    const glm::dvec3 straight(record.occlusion), bent(bentRecord(receiver, record, effects).occlusion);
    EXPECT_NEAR(glm::length(bent), glm::length(straight), 1e-12);
    return glm::length(glm::cross(straight, bent)) / glm::dot(straight, bent);
  };
  for (const glm::dvec3& place :
       {glm::dvec3(0.3, 0.1, 0.7), glm::dvec3(-2.0, 0.4, 1.1), glm::dvec3(5.0, -3.0, 0.2)}) {
    const double once = tangentAt(place, 0.1);
    ASSERT_GT(once, 1e-4);
    EXPECT_NEAR(tangentAt(place, 0.2) / once, 2.0, 1e-9);
    EXPECT_NEAR(tangentAt(place, 0.05) / once, 0.5, 1e-9);
    EXPECT_EQ(tangentAt(place, 0.0), 0.0);
  }
}

// A receiver's normal is bent by waves as the directions of its records are.
TEST(BentReceiver, Waves_BendItsNormalAsTheyBendDirections) {
  OccluderReceiver receiver = upwards();
  receiver.position = {0.3, 0.1, 0.7};
  OccluderRecord record;
  record.occlusion = glm::dvec4(receiver.normal, 1.0);
  OccluderEffects effects;
  EXPECT_EQ(bentReceiver(receiver, effects).normal, receiver.normal);
  effects.waves = effects.normalWaves = 0.3;
  const glm::dvec3 normal = bentReceiver(receiver, effects).normal;
  EXPECT_GT(glm::length(glm::cross(normal, receiver.normal)), 1e-3);
  EXPECT_NEAR(glm::length(normal - glm::dvec3(bentRecord(receiver, record, effects).occlusion)), 0.0, 1e-12);
  EXPECT_NEAR(glm::length(normal), 1.0, 1e-12);
}

TEST(WaveTable, IsItsTrainAndClosesOnItself) {
  const std::vector<glm::vec4> table = makeWaveTable();
  ASSERT_EQ(table.size(), std::size_t(waveTableSide * waveTableSide));
  double longest = 0.0, strongest = 0.0;
  glm::dvec4 sum(0.0);
  for (const glm::vec4& texel : table) {
    longest = std::max(longest, glm::length(glm::dvec3(texel)));
    strongest = std::max(strongest, std::abs(double(texel.w)));
    sum += glm::dvec4(texel);
  }
  EXPECT_NEAR(longest, 1.0, 1e-6);
  EXPECT_NEAR(strongest, 1.0, 1e-6);
  EXPECT_LT(glm::length(sum) / static_cast<double>(table.size()), 1e-6);  // Waves have no mean.
  // No step across the seam is larger than steps elsewhere.
  double inside = 0.0, seam = 0.0;
  for (int i = 0; i < waveTableSide; ++i) {
    const auto at = [&](int row, int column) {
      return glm::dvec4(
          table[static_cast<std::size_t>(row % waveTableSide * waveTableSide + column % waveTableSide)]);
    };
    seam = std::max({seam, glm::distance(at(i, 63), at(i, 64)), glm::distance(at(63, i), at(64, i))});
    for (int k = 0; k < 63; ++k) inside = std::max(inside, glm::distance(at(i, k), at(i, k + 1)));
  }
  EXPECT_LE(seam, inside * 1.5);
}

/// Amplitudes of the displacement and of the flicker of one wave, by a Fourier transform of the table.
std::pair<double, double> amplitudesOf(std::span<const glm::vec4> table, int first, int second) {
  glm::dvec4 cosines(0.0), sines(0.0);
  for (int row = 0; row < waveTableSide; ++row)
    for (int column = 0; column < waveTableSide; ++column) {
      const double angle = 2.0 * std::numbers::pi * (first * column + second * row) / waveTableSide;
      const glm::dvec4 texel(table[static_cast<std::size_t>(row * waveTableSide + column)]);
      cosines += texel * std::cos(angle);
      sines += texel * std::sin(angle);
    }
  return {std::hypot(glm::length(glm::dvec3(cosines)), glm::length(glm::dvec3(sines))),
          std::hypot(cosines.w, sines.w)};
}

// Displacement and flicker have unit vectors, and both fall with the frequency.
TEST(WaveTable, Waves_FallWithTheirFrequency) {
  const std::vector<glm::vec4> table = makeWaveTable();
  const auto [displacement, flicker] = amplitudesOf(table, 1, 0);
  EXPECT_GT(displacement, 1.0);
  EXPECT_GT(flicker, 1.0);
  for (int i = 0; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j) {
      if (i == 0 && j <= 0) continue;
      const auto [length, strength] = amplitudesOf(table, i, j);
      EXPECT_NEAR(length * std::hypot(i, j), displacement, 1e-4 * displacement) << i << ' ' << j;
      EXPECT_NEAR(strength * std::hypot(i, j), flicker, 1e-4 * flicker) << i << ' ' << j;
    }
}

TEST(WaveTable, LookUp_RepeatsEveryPeriodExactly) {
  const std::vector<glm::vec4> table = makeWaveTable();
  EXPECT_EQ(waveAt(table, 0.25, 0.625), waveAt(table, 3.25, -1.375));
  EXPECT_EQ(effectMoment(1.25), effectMoment(1.25 + 5.0 * effectPeriod));
  EXPECT_EQ(effectMoment(-0.5), effectMoment(7.5));
  EXPECT_LT(effectMoment(1e6 + 0.3), 1.0);
}

}  // namespace
}  // namespace prelight

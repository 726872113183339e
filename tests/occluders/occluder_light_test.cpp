#include "occluders/occluder_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "support/scenes.h"

namespace prelight {
namespace {

using std::numbers::pi;

const std::vector<OccluderVector> stored = {OccluderVector::Position, OccluderVector::Occlusion,
                                            OccluderVector::DiffuseNormal, OccluderVector::DiffuseColor};

/// Transfer of one vertex at the origin that faces +Y and sees one occluder.
OccluderTransfer oneRecord(const glm::vec4& position, const glm::vec4& occlusion, const glm::vec4& normal,
                           const glm::vec4& color) {
  return {{"occluder"}, stored, {0, 1}, {0}, {position, occlusion, normal, color}};
}

/// A dense ball straight above the vertex.
OccluderTransfer ballAbove(float formFactor = 0.25f) {
  return oneRecord({0, 2, 0, 2}, {0, 0.95f * formFactor, 0, formFactor},
                   {0, -0.8f * formFactor, 0, 0.9f * formFactor}, {0.5f, 0.25f, 1.0f, 0.0f});
}

const OccluderReceiver receiver{0, {0, 0, 0}, {0, 1, 0}};

IncidentLight from(const glm::dvec3& direction) { return {glm::dvec3(1.0), glm::normalize(direction)}; }

LightAt pointLight(const glm::dvec3& position, double intensity) {
  return [=](const glm::dvec3& point) {
    const glm::dvec3 path = position - point;
    const double d2 = std::max(glm::dot(path, path), 1e-12);
    return IncidentLight{glm::dvec3(intensity / d2), path / std::sqrt(d2), std::sqrt(d2)};
  };
}

TEST(OccluderLight, ThesisFormula_IsItsSinePower) {
  const OccluderTransfer transfer = ballAbove();
  const OccluderShading shading{OccluderFormula::Thesis, 1.5, 0.0};
  for (const double angle : {0.3, 0.8, 1.4}) {
    const double got = visibilityOf(transfer, receiver, from({std::sin(angle), std::cos(angle), 0}), shading);
    EXPECT_NEAR(got, std::pow(std::sin(angle), 2.0 * 1.5 * 0.25), 1e-6) << angle;
  }
  EXPECT_NEAR(visibilityOf(transfer, receiver, from({0, 1, 0}), shading), 0.0, 1e-6);
  // At a right angle and beyond nothing is hidden.
  EXPECT_EQ(visibilityOf(transfer, receiver, from({1, 0, 0}), shading), 1.0);
  EXPECT_EQ(visibilityOf(transfer, receiver, from({1, -1, 0}), shading), 1.0);
}

TEST(OccluderLight, SoftFormula_HidesTheMiddleAndNothingAside) {
  const OccluderTransfer transfer = ballAbove();
  EXPECT_LT(visibilityOf(transfer, receiver, from({0, 1, 0}), {}), 0.01);
  EXPECT_GT(visibilityOf(transfer, receiver, from({1, 0.3, 0}), {}), 0.99);
  double before = 0.0;
  for (double angle = 0.0; angle < 1.5; angle += 0.05) {
    const double visibility =
        visibilityOf(transfer, receiver, from({std::sin(angle), std::cos(angle), 0}), {});
    EXPECT_GE(visibility, before - 1e-12);
    before = visibility;
  }
}

TEST(OccluderLight, SoftFormula_LightBeforeTheOccluder_IsNotHidden) {
  const OccluderTransfer transfer = ballAbove();
  const auto at = [&](double height) {
    IncidentLight light = from({0, 1, 0});
    light.distance = height;
    return visibilityOf(transfer, receiver, light, {});
  };
  EXPECT_EQ(at(1.0), 1.0);
  EXPECT_LT(at(5.0), 0.01);
}

// A vertex of a floor below a cone that stands on it. Ambient occlusion leaves nothing of the base's normals
// and only a little of the sides', which agree.
TEST(OccluderLight, SoftFormula_BelowWhatStandsOnIt_IsDark) {
  const glm::vec4 sides(0.0006f, 0.0025f, 0.0059f, 0.0065f);
  const OccluderTransfer transfer = oneRecord({0, 0.02f, 0, 0.03f}, {0, 0.654f, 0, 0.98f}, sides, {});
  std::mt19937 random(4);
  for (int i = 0; i < 200; ++i) {
    glm::dvec3 d(test::randomDirection(random));
    d.y = std::abs(d.y);
    IncidentLight light = from(d);
    light.distance = 10.0;
    EXPECT_LT(visibilityOf(transfer, receiver, light, {}), 0.2) << d.x << " " << d.y << " " << d.z;
  }
}

// A wall beside the vertex, with most of its normals removed by ambient occlusion. Light in front of the wall
// is not hidden at any distance.
TEST(OccluderLight, SoftFormula_LightBeforeAWall_IsNotHidden) {
  const OccluderTransfer transfer =
      oneRecord({1, 1, 0, 2}, {0.25f, 0.2f, 0, 0.35f}, {-0.01f, 0, 0, 0.01f}, {});
  IncidentLight light = from({0.2, 1, 0});
  for (const double distance : {1.0, 3.0, 4.5}) {
    light.distance = distance;
    EXPECT_EQ(visibilityOf(transfer, receiver, light, {}), 1.0) << distance;
  }
  light = from({1, 0.8, 0});
  light.distance = 4.0;
  EXPECT_LT(visibilityOf(transfer, receiver, light, {}), 0.2);
}

// Glass that passes light straight is as dark as its opacity says, however dense its blob is.
TEST(OccluderLight, SoftFormula_ClearOccluder_HidesByItsOpacity) {
  OccluderTransfer transfer = ballAbove();
  transfer.stored.insert(transfer.stored.begin() + 2, OccluderVector::Transmissive);
  transfer.vectors.insert(transfer.vectors.begin() + 2, glm::vec4(0.75f, 0.3f, 0.0f, 0.0f));
  const LightAt above = [](const glm::dvec3&) { return from({0, 1, 0}); };
  OccluderShading shading;
  shading.bleeding = 0.0;
  const glm::dvec3 light = litThroughOccluders(transfer, receiver, std::span(&above, 1), shading).diffuse;
  // The second term of the sum of blobs removes a thousandth.
  EXPECT_NEAR(light.x * pi, 0.75, 2e-3);
  EXPECT_NEAR(light.y * pi, 0.3, 2e-3);
  EXPECT_NEAR(light.z * pi, 0.0, 2e-3);
}

TEST(OccluderLight, SoftFormula_WhatIsEnclosed_IsDark) {
  OccluderTransfer transfer{{"walls"}, stored, {0, 6}, {}, {}};
  for (int i = 0; i < 6; ++i) {
    const glm::vec3 d = i == 0 ? glm::vec3(0, 1, 0)
                               : glm::normalize(glm::vec3(std::cos(1.2566f * static_cast<float>(i)), 0.5f,
                                                          std::sin(1.2566f * static_cast<float>(i))));
    const float f = 1.0f / 6.0f;
    transfer.occluders.push_back(0);
    transfer.vectors.insert(transfer.vectors.end(), {glm::vec4(2.0f * d, 2.0f), glm::vec4(0.8f * f * d, f),
                                                     glm::vec4(-0.5f * f * d, f), glm::vec4(0.5f)});
  }
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    glm::dvec3 d(test::randomDirection(random));
    d.y = std::abs(d.y);
    EXPECT_LT(visibilityOf(transfer, receiver, from(d), {}), 0.35);
  }
}

TEST(OccluderLight, OpenVertex_IsLambert) {
  const OccluderTransfer transfer{{}, stored, {0, 0}, {}, {}};
  const std::vector<LightAt> lights = {pointLight({0, 2, 0}, 8.0), pointLight({3, 3, 0}, 18.0)};
  const glm::dvec3 light = litThroughOccluders(transfer, receiver, lights, {}).diffuse;
  EXPECT_NEAR(light.x, (8.0 / 4.0 + 18.0 / 18.0 * std::sqrt(0.5)) / pi, 1e-9);
}

// A lit surface that faces the vertex sends albedo x cosine x irradiance / pi, times its weight.
TEST(OccluderLight, LitOccluder_BleedsItsColor) {
  const OccluderTransfer transfer = ballAbove();
  const LightAt below = pointLight({0, 1, 0}, 3.0);
  OccluderShading shading;
  const auto with = litThroughOccluders(transfer, receiver, std::span(&below, 1), shading).diffuse;
  shading.bleeding = 0.0;
  const auto without = litThroughOccluders(transfer, receiver, std::span(&below, 1), shading).diffuse;
  const double expected = 0.8 * 0.25 * 3.0 / pi;
  EXPECT_NEAR(with.x - without.x, 0.5 * expected, 1e-7);
  EXPECT_NEAR(with.z - without.z, 1.0 * expected, 1e-7);
}

OccluderTransfer randomTransfer(std::mt19937& random, int records) {
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  OccluderTransfer transfer{{"a"}, stored, {0, static_cast<std::uint32_t>(records)}, {}, {}};
  for (int i = 0; i < records; ++i) {
    const float f = unit(random) * (i % 3 == 0 ? 1e-6f : 1.0f / static_cast<float>(records));
    transfer.occluders.push_back(0);
    transfer.vectors.emplace_back(4.0f * test::randomDirection(random) * unit(random), 4.0f * unit(random));
    transfer.vectors.emplace_back(test::randomDirection(random) * (f * (i % 4 == 0 ? 0.0f : unit(random))),
                                  f);
    transfer.vectors.emplace_back(test::randomDirection(random) * (f * (i % 5 == 0 ? 0.0f : unit(random))),
                                  f);
    transfer.vectors.emplace_back(unit(random), unit(random), unit(random), 0.0f);
  }
  return transfer;
}

// The lights lie on an occluder, on the receiver, exactly along a vector, very far away, and anywhere else.
TEST(OccluderLight, MillionLightPlaces_StayFiniteAndNotNegative) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::size_t bad = 0;
  for (int round = 0; round < 1000; ++round) {
    const OccluderTransfer transfer = randomTransfer(random, 1 + round % 7);
    for (int i = 0; i < 1000; ++i) {
      glm::dvec3 place(normal(random), normal(random), normal(random));
      if (i % 10 == 0) place *= 1e6;
      if (i % 10 == 1) place = glm::dvec3(transfer.vectors[0]);
      if (i % 10 == 2) place = receiver.position;
      if (i % 10 == 3)
        place = 3.0 * glm::dvec3(transfer.vectors[1]) / std::max(1e-9, double(transfer.vectors[1].w));
      const LightAt light = pointLight(place, 1.0);
      for (const OccluderFormula formula : {OccluderFormula::Soft, OccluderFormula::Thesis}) {
        const double visibility = visibilityOf(transfer, receiver, light(receiver.position), {formula});
        const glm::dvec3 sum =
            litThroughOccluders(transfer, receiver, std::span(&light, 1), {formula}).diffuse;
        const bool good = visibility >= 0.0 && visibility <= 1.0 && std::isfinite(sum.x + sum.y + sum.z) &&
                          std::min({sum.x, sum.y, sum.z}) >= 0.0;
        bad += good ? 0 : 1;
      }
    }
  }
  EXPECT_EQ(bad, 0u);
}

}  // namespace
}  // namespace prelight

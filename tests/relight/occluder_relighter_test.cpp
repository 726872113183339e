#include "techniques/vector_occluders/occluder_relighter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "occluders/occluder_record.h"
#include "prelight/error.h"
#include "support/devices.h"
#include "support/occluders.h"
#include "support/scenes.h"

namespace prelight {
namespace {

using test::MadeOccluders;

DeviceContext& occluderDevice() { return test::sharedDevice().context(); }

OccluderReceivers receiversOf(const MadeOccluders& made) {
  return {made.positions, made.normals, glm::dvec3(0.0), made.gloss};
}

const OccluderEye eye{{2.0, 3.0, 5.0}, true};

OccludedLight referenceAt(const MadeOccluders& made, std::size_t v,
                          const std::vector<device::OccluderLight>& lights, const OccluderShading& shading) {
  const OccluderReceiver receiver = test::receiverOf(made, v, eye.position);
  std::vector<LightAt> sources;
  for (const device::OccluderLight& light : lights)
    sources.emplace_back([&light](const glm::dvec3& point) { return incidentFrom(light, point); });
  return litThroughOccluders(made.transfer, receiver, sources, shading);
}

glm::dvec3 vec(const float* v) { return {v[0], v[1], v[2]}; }

double largestOf(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Compares with the reference; `tolerance` bounds the largest difference relative to the range of each part.
void expectReference(const MadeOccluders& made, const std::vector<device::OccluderLight>& lights,
                     const OccluderShading& shading, double tolerance) {
  OccluderRelighter relighter(occluderDevice(), made.transfer, receiversOf(made));
  const std::vector<device::LitVertex> lit = relighter.relight(lights, shading, eye);
  ASSERT_EQ(lit.size(), made.positions.size());
  double range[3] = {}, error[4] = {};
  for (std::size_t v = 0; v < lit.size(); ++v) {
    const OccludedLight right = referenceAt(made, v, lights, shading);
    const glm::dvec3 rights[3] = {right.diffuse, right.specular, right.reflected};
    const glm::dvec3 gots[3] = {vec(lit[v].diffuse), vec(lit[v].specular), vec(lit[v].reflected)};
    for (int part = 0; part < 3; ++part) {
      range[part] = std::max(range[part], largestOf(rights[part]));
      error[part] = std::max(error[part], largestOf(rights[part] - gots[part]));
    }
    error[3] = std::max(error[3], std::abs(right.highlight - lit[v].highlight));
  }
  EXPECT_GT(range[0], 0.1);
  EXPECT_GT(range[1], 0.1);
  for (int part = 0; part < 3; ++part) EXPECT_LE(error[part], tolerance * range[part]) << part;
  EXPECT_LE(error[3], 10.0 * tolerance);
}

class Occluders : public ::testing::TestWithParam<OccluderFormula> {};

TEST_P(Occluders, EveryVector_AgreesWithDoubleReference) {
  OccluderShading shading;
  shading.formula = GetParam();
  const MadeOccluders made = test::makeOccluders(400, test::everyOptionalVector(), 1);
  expectReference(made, test::makeLights(9, 2), shading, 1e-4);
}

TEST_P(Occluders, AnySubsetOfVectors_AgreesWithDoubleReference) {
  OccluderShading shading;
  shading.formula = GetParam();
  for (const std::vector<OccluderVector>& optional :
       {std::vector<OccluderVector>{},
        {OccluderVector::Transmissive},
        {OccluderVector::Caustic},
        {OccluderVector::SpecularNormal, OccluderVector::SpecularColor},
        {OccluderVector::Caustic, OccluderVector::Transmissive}})
    expectReference(test::makeOccluders(200, optional, 3), test::makeLights(6, 4), shading, 1e-4);
}

TEST_P(Occluders, EveryParameterAndEffect_AgreesWithDoubleReference) {
  OccluderShading shading = test::unusualShading();
  shading.formula = GetParam();
  const MadeOccluders made = test::makeOccluders(300, test::everyOptionalVector(), 5);
  for (const MirrorFormula mirrors : {MirrorFormula::Lobe, MirrorFormula::Thesis}) {
    shading.mirrors = mirrors;
    expectReference(made, test::makeLights(8, 6), shading, 1e-4);
  }
}

// Coloured glass that is opaque in one channel alone, each channel in turn. Without caustics all transmitted
// light goes straight on, so that shadows in the other channels end at a level of their own.
TEST_P(Occluders, OpaqueInOneChannel_AgreesWithDoubleReference) {
  OccluderShading shading;
  shading.formula = GetParam();
  for (const std::vector<OccluderVector>& optional :
       {test::everyOptionalVector(), {OccluderVector::Transmissive}}) {
    MadeOccluders made = test::makeOccluders(200, optional, 9);
    const std::size_t place = placeOf(made.transfer, OccluderVector::Transmissive);
    const std::size_t stored = made.transfer.stored.size();
    for (std::size_t r = 0; r < made.transfer.occluders.size(); ++r) {
      glm::vec4 colour(0.9f, 0.6f, 0.3f, 0.0f);
      colour[static_cast<int>(r % 3)] = 0.0f;
      made.transfer.vectors[r * stored + place] = colour;
    }
    expectReference(made, test::makeLights(8, 10), shading, 1e-4);
  }
}

// Low powers give mirrored light a noticeable share.
TEST_P(Occluders, ThesisMirrors_AgreeWithDoubleReference) {
  OccluderShading shading;
  shading.formula = GetParam();
  shading.mirrors = MirrorFormula::Thesis;
  shading.specularExponent = 1.5;
  const MadeOccluders made = test::makeOccluders(300, test::everyOptionalVector(), 12);
  expectReference(made, test::makeLights(8, 13), shading, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Formulas, Occluders,
                         ::testing::Values(OccluderFormula::Soft, OccluderFormula::Thesis),
                         [](const auto& instance) {
                           return instance.param == OccluderFormula::Soft ? "Soft" : "Thesis";
                         });

TEST(OccluderRelighter, ShadingThatChanges_IsPreparedAnew) {
  const MadeOccluders made = test::makeOccluders(100, test::everyOptionalVector(), 7);
  const auto lights = test::makeLights(4, 8);
  OccluderRelighter relighter(occluderDevice(), made.transfer, receiversOf(made));
  OccluderShading changed;
  changed.causticStrength = 0.25;
  changed.effects.waves = 0.2;
  const auto before = relighter.relight(lights, {}, eye);
  const auto between = relighter.relight(lights, changed, eye);
  const auto after = relighter.relight(lights, {}, eye);
  double moved = 0.0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    EXPECT_EQ(vec(before[v].diffuse), vec(after[v].diffuse));
    moved = std::max(moved, largestOf(vec(before[v].diffuse) - vec(between[v].diffuse)));
  }
  EXPECT_GT(moved, 0.01);
}

TEST(OccluderRelighter, ManyLights_AddUp) {
  const MadeOccluders made = test::makeOccluders(300, {}, 9);
  const auto lights = test::makeLights(700, 10);  // Takes several launches.
  OccluderRelighter relighter(occluderDevice(), made.transfer, receiversOf(made));
  const auto all = relighter.relight(lights, {}, eye);
  const auto first = relighter.relight(std::span(lights).first(300), {}, eye);
  const auto rest = relighter.relight(std::span(lights).subspan(300), {}, eye);
  for (std::size_t v = 0; v < all.size(); ++v) {
    const glm::dvec3 sum = vec(first[v].diffuse) + vec(rest[v].diffuse);
    EXPECT_LE(largestOf(vec(all[v].diffuse) - sum), 1e-4 * std::max(1.0, largestOf(sum))) << v;
  }
}

TEST(OccluderRelighter, NoVertexOrNoLight_IsDark) {
  const MadeOccluders made = test::makeOccluders(10, {}, 11);
  OccluderRelighter relighter(occluderDevice(), made.transfer, receiversOf(made));
  for (const device::LitVertex& lit : relighter.relight({}, {}, eye))
    EXPECT_EQ(vec(lit.diffuse), glm::dvec3(0));
  const MadeOccluders none = test::makeOccluders(0, {}, 12);
  OccluderRelighter empty(occluderDevice(), none.transfer, receiversOf(none));
  EXPECT_TRUE(empty.relight(test::makeLights(2, 1), {}, eye).empty());
}

TEST(OccluderRelighter, WrongReceiversOrVectors_AreNamed) {
  MadeOccluders made = test::makeOccluders(10, {}, 13);
  OccluderReceivers receivers = receiversOf(made);
  receivers.normals = receivers.normals.first(9);
  EXPECT_THROW(OccluderRelighter(occluderDevice(), made.transfer, receivers), UsageError);
  made.transfer.stored[0] = OccluderVector::Caustic;
  EXPECT_THROW(OccluderRelighter(occluderDevice(), made.transfer, receiversOf(made)), UsageError);
}

}  // namespace
}  // namespace prelight

// Encoded light of texels and vertices, compared with encodings of light in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "basis/sh_evaluate.h"
#include "encodings/registry/registry.h"
#include "prelight/error.h"
#include "receivers/surface_sampler.h"
#include "scene/surface/surface_frame.h"
#include "support/devices.h"
#include "support/materials.h"
#include "support/scenes.h"
#include "techniques/encoded_light/encoding_names.h"
#include "techniques/light_map/light_map_plan.h"

namespace prelight {
namespace {

glm::vec3 turned(float azimuth, float height) {
  const float s = std::sqrt(1.0f - height * height);
  return {s * std::cos(azimuth), s * std::sin(azimuth), height};
}

TEST(SurfaceFrame, AnyNormal_IsOrthonormalAndRightHanded) {
  for (float azimuth = 0.0f; azimuth < 6.3f; azimuth += 0.1f)
    for (float height = -1.0f; height <= 1.0f; height += 0.05f) {
      const glm::vec3 n = turned(azimuth, height);
      const glm::mat3 frame = surfaceFrame(n);
      EXPECT_EQ(frame[2], n);
      const glm::mat3 product = glm::transpose(frame) * frame;
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) ASSERT_NEAR(product[i][k], i == k ? 1.0f : 0.0f, 1e-5f);
      ASSERT_NEAR(glm::determinant(frame), 1.0f, 1e-5f);
    }
  const glm::mat3 along = surfaceFrame({0.36f, 0.48f, 0.8f});
  EXPECT_NEAR(glm::length(along[0]), 1.0f, 1e-6f);
  EXPECT_NEAR(glm::dot(along[0], along[2]), 0.0f, 1e-6f);
}

/// Interpolation between places needs continuous tangents: turning the normal by a hundredth of a radian
/// turns the tangent a little, except near the one direction without a tangent. Walls along the axes are far
/// from it, and both signs of a 0 give the same frame.
TEST(SurfaceFrame, NormalsSideBySide_HaveTangentsSideBySide) {
  for (float azimuth = 0.0f; azimuth < 6.3f; azimuth += 0.1f)
    for (float height = -0.95f; height < 0.95f; height += 0.05f) {
      const glm::vec3 n = turned(azimuth, height), m = turned(azimuth + 0.01f, height);
      if (std::abs(glm::dot(n, glm::vec3(0.36f, 0.48f, 0.8f))) > 0.9f) continue;
      EXPECT_LT(glm::distance(surfaceFrame(n)[0], surfaceFrame(m)[0]), 0.04f);
    }
  EXPECT_EQ(surfaceFrame({0.0f, 1.0f, -0.0f}), surfaceFrame({0.0f, 1.0f, 0.0f}));
}

TEST(EncodingNames, UnknownOne_IsRefusedWithTheKnownOnesAndTheNearest) {
  const std::string known(encodings().front().name);
  EXPECT_EQ(requireEncoding("--encode", known).name, known);
  try {
    requireEncoding("--encode", known + "x");
    FAIL();
  } catch (const UsageError& error) {
    const std::string text = error.what();
    for (const std::string& part : {"--encode " + known + "x", "did you mean " + known, encodingNames()})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

constexpr double sunPower = 3.0;
const glm::dvec3 toSun = glm::normalize(glm::dvec3(0.6, 0.7, 0.2));

/// A white two-sided sheet under a sun, without reflected light.
CompiledScene sunlitSheet() {
  CompiledScene scene = test::ground(6, 1.0f);
  scene.materials[0] = test::lambert(0.5f);
  scene.materials[0].doubleSided = true;
  Light sun;
  sun.type = LightType::Directional;
  sun.direction = -toSun;
  sun.intensity = {static_cast<float>(sunPower), 0.0f, 2.0f * static_cast<float>(sunPower)};
  scene.lights = {sun};
  return scene;
}

BakeRequest encodedRequest() {
  BakeRequest request;
  request.lightMap.wanted = true;
  request.lightMap.texelSize = 0.1;
  request.effort.rays = 64;
  for (const Encoding& encoding : encodings()) request.encodedLight.encodings.emplace_back(encoding.name);
  return request;
}

Bake bake(const CompiledScene& scene, const BakeRequest& request) {
  const Scene source;
  Progress progress;
  BakeReport report;
  return bakeScene(scene, request, makePlan(source, scene, request), test::sharedDevice(), progress, report,
                   nullptr, &source);
}

/// Incident radiance of the sun, [channel][term]: its perpendicular irradiance times the functions in its
/// direction.
std::array<float, 75> sunlight() {
  std::array<double, 25> functions{};
  sh::evaluate(toSun, 5, functions);
  std::array<float, 75> incident{};
  for (std::size_t i = 0; i < 25; ++i) {
    incident[i] = static_cast<float>(sunPower * functions[i]);
    incident[50 + i] = 2.0f * incident[i];
  }
  return incident;
}

/// Expects that stored values give, for normals around a place's own, the irradiance that the encoding gives
/// for `incident`.
void expectEncoded(const Encoding& encoding, std::span<const float> values, const glm::vec3& normal,
                   std::span<const float> incident) {
  const glm::mat3 frame = surfaceFrame(normal);
  std::vector<float> expected(encoding.values);
  encoding.encode(incident, frame, expected);
  for (const glm::vec3& aside :
       {glm::vec3(0, 0, 1), glm::vec3(0.5f, 0, 0.8f), glm::vec3(-0.2f, -0.6f, 0.7f)}) {
    const glm::vec3 m = glm::normalize(frame * aside);
    const glm::vec3 want = encoding.irradiance(expected, frame, m),
                    got = encoding.irradiance(values, frame, m);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], want[c], 0.02 * sunPower) << encoding.name << " " << c;
  }
}

TEST(EncodedLight, SunOnASheet_IsEncodedAtTexelsAndVertices) {
  const CompiledScene scene = sunlitSheet();
  const Bake found = bake(scene, encodedRequest());
  ASSERT_TRUE(found.lightMap);
  ASSERT_EQ(found.lightMap->encoded.size(), encodings().size());
  ASSERT_EQ(found.encodedLight.size(), encodings().size());
  const std::array<float, 75> incident = sunlight(), dark{};
  std::size_t backs = 0;
  for (std::size_t e = 0; e < encodings().size(); ++e) {
    const Encoding& encoding = encodings()[e];
    const EncodedLight &texels = found.lightMap->encoded[e], &vertices = found.encodedLight[e];
    EXPECT_EQ(texels.encoding, encoding.name);
    EXPECT_EQ(vertices.encoding, encoding.name);
    ASSERT_EQ(texels.values.size(), found.lightMap->layout.texelCount() * encoding.values);
    ASSERT_EQ(vertices.values.size(), scene.vertexCount() * encoding.values);
    const auto at = [&](const EncodedLight& light, std::size_t place) {
      return std::span(light.values).subspan(place * encoding.values, encoding.values);
    };
    for (const LightMapTexel& texel : found.lightMap->layout.texels) {
      const bool back = texel.face >= scene.triangleCount();
      backs += back ? 1 : 0;
      expectEncoded(encoding, at(texels, texel.texel), {0, back ? -1 : 1, 0}, back ? dark : incident);
    }
    for (std::size_t v = 0; v < scene.vertexCount(); ++v)
      expectEncoded(encoding, at(vertices, v), scene.normals[v], incident);
  }
  EXPECT_GT(backs, 100u);
}

/// Encodings do not change the light map's own values.
TEST(EncodedLight, LightMapBesideIt_IsAsItIsAlone) {
  const CompiledScene scene = sunlitSheet();
  BakeRequest request = encodedRequest();
  const Bake with = bake(scene, request);
  request.encodedLight = {};
  const Bake without = bake(scene, request);
  EXPECT_EQ(with.lightMap->coefficients, 1);
  EXPECT_TRUE(without.lightMap->encoded.empty());
  EXPECT_TRUE(without.encodedLight.empty());
  ASSERT_EQ(with.lightMap->values.size(), without.lightMap->values.size());
  for (std::size_t i = 0; i < with.lightMap->values.size(); ++i)
    ASSERT_NEAR(with.lightMap->values[i], without.lightMap->values[i], 1e-5f);
  ASSERT_EQ(with.irradiance->size(), without.irradiance->size());
  for (std::size_t v = 0; v < with.irradiance->size(); ++v)
    ASSERT_NEAR((*with.irradiance)[v].x, (*without.irradiance)[v].x, 1e-5f);
}

const PlannedPass* passOf(const Plan& plan) {
  const auto found = std::ranges::find(plan.passes, Pass::EncodedLight.name, &PlannedPass::name);
  return found == plan.passes.end() ? nullptr : &*found;
}

TEST(EncodedLight, Plan_SaysWhyItRunsOrNot) {
  CompiledScene scene = sunlitSheet();
  BakeRequest request = encodedRequest();
  const auto reasonOf = [&](bool runs) {
    const Plan plan = makePlan(Scene(), scene, request);
    const PlannedPass* pass = passOf(plan);
    if (pass == nullptr) return std::string("no line");
    EXPECT_EQ(pass->runs, runs) << pass->reason;
    return pass->reason;
  };
  const std::string runs = reasonOf(true);
  for (const Encoding& encoding : encodings())
    EXPECT_NE(runs.find(std::string(encoding.name) + " (" + std::to_string(encoding.values)),
              std::string::npos)
        << runs;
  const Plan plan = makePlan(Scene(), scene, request);
  EXPECT_EQ(lightMapCoefficients(plan), 26);
  EXPECT_EQ(keptLightMapCoefficients(plan), 1);
  const std::uint64_t bytes = plan.hostBytes;
  request.encodedLight.encodings.pop_back();
  EXPECT_LT(makePlan(Scene(), scene, request).hostBytes, bytes);
  request.encodedLight = {};
  EXPECT_EQ(reasonOf(false), "no line");
  EXPECT_EQ(lightMapCoefficients(makePlan(Scene(), scene, request)), 1);
  request.lightMap.wanted = false;
  request.ao = true;
  EXPECT_EQ(reasonOf(false), "no line");
  request = encodedRequest();
  request.lightMap.wanted = false;
  request.ao = true;
  EXPECT_NE(reasonOf(false).find("light map, which is not asked for"), std::string::npos);
  request.lightMap.wanted = true;
  scene.materials[0] = test::lambert(0.0f);
  EXPECT_NE(reasonOf(false).find("no surface reflects diffusely"), std::string::npos);
}

/// The key of a state depends on the encodings; without encodings it is the same as before encodings existed.
TEST(EncodedLight, StateOfAnInterruptedBake_DependsOnTheEncodings) {
  const CompiledScene scene = sunlitSheet();
  const DeviceInfo& device = test::sharedDevice().info();
  BakeRequest request = encodedRequest();
  const StateKey all = bakeKey(scene, request, device);
  request.encodedLight.encodings.pop_back();
  EXPECT_NE(bakeKey(scene, request, device), all);
  request.encodedLight = {};
  EXPECT_NE(bakeKey(scene, request, device), all);
}

}  // namespace
}  // namespace prelight

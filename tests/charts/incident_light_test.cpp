// Directional light of texels, and its irradiance under normal maps, against closed forms and quadrature.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>

#include "basis/sh_evaluate.h"
#include "charts/direct_light.h"
#include "charts/layout_places.h"
#include "support/devices.h"
#include "support/mapped_irradiance.h"
#include "support/scenes.h"
#include "techniques/light_map/light_map_parts.h"

namespace prelight {
namespace {

using std::numbers::pi;
const double constant = std::sqrt(1.0 / (4.0 * pi)), linear = std::sqrt(3.0 / (4.0 * pi));

/// Light of a texel from the integrals of radiance and of radiance times direction, the same in all channels.
MapLight mapLight(double all, const glm::dvec3& vector, double irradiance) {
  const auto grey = [](double value) { return glm::dvec3(value); };
  return {grey(irradiance), grey(constant * all), grey(linear * vector.y), grey(linear * vector.z),
          grey(linear * vector.x)};
}

glm::dvec3 tilted(double angle, double azimuth) {
  return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle)};
}

constexpr glm::dvec3 up(0.0, 0.0, 1.0);

TEST(MappedIrradiance, SkyAndALamp_AreExactForEveryNormal) {
  for (const double sky : {0.0, 0.3, 2.0})
    for (const double lampAngle : {0.0, 0.5, 1.2})
      for (const double lamp : {0.0, 1.0, 7.0}) {
        const glm::dvec3 way = tilted(lampAngle, 0.4);
        const double own = pi * sky + lamp * way.z;
        const MapLight light = mapLight(2.0 * pi * sky + lamp, pi * sky * up + lamp * way, own);
        for (double angle = 0.0; angle < 1.5; angle += 0.25)
          for (double azimuth = 0.0; azimuth < 6.0; azimuth += 0.7) {
            const glm::dvec3 m = tilted(angle, azimuth);
            const double expected = 0.5 * pi * sky * (1.0 + m.z) + lamp * std::max(glm::dot(m, way), 0.0);
            ASSERT_NEAR(mappedIrradiance(light, up, m).x, expected, 1e-6 * (1.0 + own))
                << sky << " " << lampAngle << " " << lamp << " " << angle;
          }
      }
}

TEST(MappedIrradiance, OwnNormal_GetsTheMapsIrradianceAndNothingIsNegative) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 vector(uniform(random), uniform(random), uniform(random));
    // Between texels the irradiance need not agree with the rest.
    const double irradiance = std::abs(uniform(random));
    const MapLight light = mapLight(2.0 * uniform(random), vector, irradiance);
    ASSERT_NEAR(mappedIrradiance(light, up, up).y, irradiance, 1e-12);
    ASSERT_GE(mappedIrradiance(light, up, tilted(1.5 * std::abs(uniform(random)), 3.0 * uniform(random))).y,
              0.0);
  }
  EXPECT_EQ(mappedIrradiance(mapLight(0.0, glm::dvec3(0.0), 0.0), up, tilted(0.5, 0.0)).x, 0.0);
}

using Radiance = std::function<double(const glm::dvec3&)>;

/// Integral of radiance x f(direction) over the upper hemisphere.
template <typename Value, typename Function>
Value integrate(const Radiance& radiance, const Function& f) {
  constexpr int rings = 200, steps = 400;
  Value sum(0.0);
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < steps; ++k) {
      const double z = (i + 0.5) / rings;
      const glm::dvec3 w = tilted(std::acos(z), 2.0 * pi * (k + 0.5) / steps);
      sum += radiance(w) * (2.0 * pi / (rings * steps)) * f(w);
    }
  return sum;
}

/// For lights that are neither a sky nor a lamp the formula is an approximation. It is better than the
/// irradiance of the bands alone, F / 4 + V.m / 2. Both are compared by their difference from the irradiance
/// at the surface's own normal.
TEST(MappedIrradiance, WallsAndWideLamps_AreNearerThanByTheBandsAlone) {
  const Radiance lights[] = {
      [](const glm::dvec3& w) { return w.x > 0.5 ? 1.0 : 0.0; },
      [](const glm::dvec3& w) { return w.x > 0.0 ? 1.0 : 0.0; },
      [](const glm::dvec3& w) { return glm::dot(w, tilted(1.0, 0.3)) > std::cos(0.35) ? 5.0 : 0.2; },
      [](const glm::dvec3& w) { return 0.3 + (w.x > 0.5 ? 0.7 : 0.0) + (w.y < -0.6 ? 0.5 : 0.0); }};
  for (const Radiance& radiance : lights) {
    const double all = integrate<double>(radiance, [](const glm::dvec3&) { return 1.0; });
    const glm::dvec3 vector = integrate<glm::dvec3>(radiance, [](const glm::dvec3& w) { return w; });
    const MapLight light = mapLight(all, vector, vector.z);
    double error = 0.0, bandError = 0.0;
    for (const double angle : {0.2, 0.4, 0.7})
      for (double azimuth = 0.0; azimuth < 6.2; azimuth += pi / 4.0) {
        const glm::dvec3 m = tilted(angle, azimuth);
        const double expected =
            integrate<double>(radiance, [&](const glm::dvec3& w) { return std::max(glm::dot(w, m), 0.0); });
        error += std::pow(mappedIrradiance(light, up, m).x / vector.z - expected / vector.z, 2.0) / 24.0;
        const double bands = std::max(vector.z + 0.5 * glm::dot(vector, m - up), 0.0);
        bandError += std::pow((bands - expected) / vector.z, 2.0) / 24.0;
      }
    EXPECT_LT(std::sqrt(error), 0.09);
    EXPECT_LT(error, 0.5 * bandError);
  }
}

using test::layoutOf;
using test::positionOf;

/// Values of a layout's texels under one part, [texel][channel][coefficient].
std::vector<float> valuesOf(LightMapPart& part, const LightMapLayout& layout, int coefficients = 5) {
  std::vector<float> values(3 * static_cast<std::size_t>(coefficients) * layout.texels.size(), 0.0f);
  std::vector<std::uint8_t> hidden(layout.texels.size(), 0);
  part.add(layout.texels, coefficients, values, hidden);
  return values;
}

/// A lamp of intensity I at distance r in direction w gives F = I / r2 and V = F w.
TEST(IncidentLight, PointLight_HasTheClosedForm) {
  CompiledScene scene = test::ground(4, 1.0f);
  const glm::dvec3 place(0.2, 1.0, -0.3);
  Light light;
  light.position = place;
  light.intensity = {3.0f, 2.0f, 0.0f};
  scene.lights = {light};
  Tracer tracer(scene, test::sharedDevice());
  test::DirectLight part(scene, tracer, 16, 0, 5);
  const LightMapLayout layout = layoutOf(scene, 0.1);
  const std::vector<float> values = valuesOf(part, layout);
  for (std::size_t i = 0; i < layout.texels.size(); ++i) {
    const glm::dvec3 way = place - positionOf(scene, layout.texels[i]), w = glm::normalize(way);
    const double all = 3.0 / glm::dot(way, way);
    const double expected[] = {all * w.y, constant * all, linear * all * w.y, linear * all * w.z,
                               linear * all * w.x};
    for (std::size_t k = 0; k < 5; ++k) {
      ASSERT_NEAR(values[15 * i + k], expected[k], 2e-5) << k;
      ASSERT_NEAR(values[15 * i + 5 + k], expected[k] * 2.0 / 3.0, 2e-5);
      ASSERT_EQ(values[15 * i + 10 + k], 0.0f);
    }
  }
}

/// Irradiance and the 25 functions of the lamp's direction: the kernels' polynomials against the recurrence
/// in doubles.
TEST(IncidentLight, PointLightOfOrderFive_HasTheFunctionsOfItsWay) {
  CompiledScene scene = test::ground(4, 1.0f);
  Light light;
  light.position = glm::dvec3(0.3, 0.8, -0.4);
  light.intensity = {3.0f, 0.0f, 6.0f};
  scene.lights = {light};
  Tracer tracer(scene, test::sharedDevice());
  test::DirectLight part(scene, tracer, 16, 0, 26);
  const LightMapLayout layout = layoutOf(scene, 0.1);
  const std::vector<float> values = valuesOf(part, layout, 26);
  for (std::size_t i = 0; i < layout.texels.size(); ++i) {
    const glm::dvec3 way = light.position - positionOf(scene, layout.texels[i]), w = glm::normalize(way);
    const double all = 3.0 / glm::dot(way, way);
    std::array<double, 25> functions{};
    sh::evaluate(w, 5, functions);
    const float* of = &values[78 * i];
    // Receivers stay off the surface by as much as rounding may move them.
    ASSERT_NEAR(of[0], all * w.y, 1e-5 * all);
    for (std::size_t k = 0; k < 25; ++k) {
      ASSERT_NEAR(of[1 + k], all * functions[k], 1e-4) << k;
      ASSERT_EQ(of[26 + 1 + k], 0.0f);
      ASSERT_NEAR(of[52 + 1 + k], 2.0 * all * functions[k], 2e-4) << k;
    }
  }
}

/// The low bands are the same whether or not higher bands are requested.
template <typename MakePart>
void expectSameLowBands(const CompiledScene& scene, const MakePart& makePart) {
  const LightMapLayout layout = layoutOf(scene, 0.1);
  const std::vector<float> few = valuesOf(*makePart(5), layout, 5),
                           many = valuesOf(*makePart(26), layout, 26);
  ASSERT_GT(*std::max_element(few.begin(), few.end()), 0.0f);
  for (std::size_t i = 0; i < few.size(); ++i) ASSERT_EQ(few[i], many[i / 5 * 26 + i % 5]) << i;
}

TEST(IncidentLight, LowBandsOfOrderFive_AreThoseOfOrderTwo) {
  CompiledScene scene = test::ground(4, 1.0f);
  Light light;
  light.position = glm::dvec3(0.2, 1.0, -0.3);
  scene.lights = {light};
  const Environment sky = constantEnvironment(glm::vec3(0.5f, 1.0f, 2.0f));
  Tracer tracer(scene, test::sharedDevice());
  expectSameLowBands(scene, [&](int coefficients) {
    return std::make_unique<test::DirectLight>(scene, tracer, 16, 0, coefficients);
  });
  expectSameLowBands(scene,
                     [&](int) { return std::make_unique<SkyLightPart>(scene, tracer, sky, 0.0, 64, 0); });
}

/// Solid angle of a triangle of unit directions (Van Oosterom and Strackee 1983).
double solidAngle(const std::array<glm::dvec3, 3>& d) {
  return 2.0 * std::atan2(std::abs(glm::dot(d[0], glm::cross(d[1], d[2]))),
                          1.0 + glm::dot(d[0], d[1]) + glm::dot(d[1], d[2]) + glm::dot(d[2], d[0]));
}

/// Integral of the direction over a spherical triangle: half of each side's angle along its plane's normal
/// (Lambert 1760).
glm::dvec3 directionIntegral(const std::array<glm::dvec3, 3>& d) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 across = glm::cross(d[i], d[(i + 1) % 3]);
    sum += 0.5 * std::atan2(glm::length(across), glm::dot(d[i], d[(i + 1) % 3])) * glm::normalize(across);
  }
  return glm::dot(sum, d[0]) < 0.0 ? -sum : sum;
}

TEST(IncidentLight, Emitter_HasItsSolidAngleAndItsVector) {
  CompiledScene scene = test::ground(4, 1.0f);
  CompiledScene lamp = test::ground(1, 0.5f, 1.0f);
  for (glm::uvec3& t : lamp.triangles) std::swap(t.y, t.z);
  test::append(scene, lamp);
  scene.materials.push_back(scene.materials[0]);
  const auto emissive = static_cast<std::uint32_t>(scene.materials.size() - 1);
  scene.materials[emissive].emission = glm::vec3(10.0f);
  scene.triangleMaterials[32] = scene.triangleMaterials[33] = emissive;
  Tracer tracer(scene, test::sharedDevice());
  test::DirectLight part(scene, tracer, 2048, 0, 5);
  const LightMapLayout layout = layoutOf(scene, 0.25);
  const std::vector<float> values = valuesOf(part, layout);
  std::array<double, 5> error{}, sum{};
  for (std::size_t i = 0; i < layout.texels.size(); ++i) {
    if (layout.texels[i].face >= 32) continue;
    double all = 0.0;
    glm::dvec3 vector(0.0);
    for (const std::size_t t : {32u, 33u}) {
      std::array<glm::dvec3, 3> d;
      for (int k = 0; k < 3; ++k)
        d[static_cast<std::size_t>(k)] = glm::normalize(glm::dvec3(scene.positions[scene.triangles[t][k]]) -
                                                        positionOf(scene, layout.texels[i]));
      all += 10.0 * solidAngle(d);
      vector += 10.0 * directionIntegral(d);
    }
    const double expected[] = {vector.y, constant * all, linear * vector.y, linear * vector.z,
                               linear * vector.x};
    for (std::size_t k = 0; k < 5; ++k) {
      ASSERT_NEAR(values[15 * i + k], expected[k], 0.04 * (k == 0 ? vector.y : linear * all))
          << i << " " << k;
      error[k] += values[15 * i + k] - expected[k];
      sum[k] += k == 0 ? vector.y : linear * all;
    }
  }
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(error[k] / sum[k], 0.0, 0.004) << k;
}

TEST(IncidentLight, EvenSky_IsHalfASphere) {
  const CompiledScene scene = test::ground(2, 1.0f);
  const Environment sky = constantEnvironment(glm::vec3(0.5f, 1.0f, 2.0f));
  Tracer tracer(scene, test::sharedDevice());
  SkyLightPart part(scene, tracer, sky, 0.0, 1024, 0);
  const LightMapLayout layout = layoutOf(scene, 0.25);
  const std::vector<float> values = valuesOf(part, layout);
  const double expected[] = {pi, constant * 2.0 * pi, linear * pi, 0.0, 0.0};
  for (std::size_t i = 0; i < layout.texels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 5; ++k)
        ASSERT_NEAR(values[15 * i + 5 * c + k], 0.5 * std::pow(2.0, double(c)) * expected[k],
                    0.02 * std::pow(2.0, double(c)))
            << k;
}

TEST(IncidentLight, EvenSkyOfOrderFive_IsHalfASphere) {
  const CompiledScene scene = test::ground(2, 1.0f);
  const Environment sky = constantEnvironment(glm::vec3(1.0f));
  Tracer tracer(scene, test::sharedDevice());
  SkyLightPart part(scene, tracer, sky, 0.0, 4096, 0);
  const LightMapLayout layout = layoutOf(scene, 0.5);
  const std::vector<float> values = valuesOf(part, layout, 26);
  std::array<double, 25> expected{};
  constexpr int rings = 400, steps = 64;
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < steps; ++k) {
      const double y = (i + 0.5) / rings, s = std::sqrt(1.0 - y * y), azimuth = 2.0 * pi * (k + 0.5) / steps;
      std::array<double, 25> functions{};
      sh::evaluate({s * std::cos(azimuth), y, s * std::sin(azimuth)}, 5, functions);
      for (std::size_t f = 0; f < 25; ++f) expected[f] += functions[f] * 2.0 * pi / (rings * steps);
    }
  for (std::size_t i = 0; i < layout.texels.size(); ++i)
    for (std::size_t f = 0; f < 25; ++f) ASSERT_NEAR(values[78 * i + 1 + f], expected[f], 0.03) << f;
}

}  // namespace
}  // namespace prelight

// Area lights in OpenGL compared with integrals over them in double precision.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>

#include "viewer/lights/illumination.h"
#include "viewer/lights/lighting.h"
#include "viewer/options/light_option.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using namespace test;
using std::numbers::pi;
using viewer::parseLight;
using viewer::Shading;

constexpr int steps = 400;

/// Radiance of a white surface at the origin that faces +Z.
double shaded(const Light& light, Shading shading = Shading::Phong) {
  QuadScene quad;
  quad.add(lambertian(glm::vec3(1.0f)));
  quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
  quad.setSky(constantEnvironment(glm::vec3(0)));
  quad.scene.lights = {light};
  quad.compile();
  return pixelAt(quad.render(square(shading))).x;
}

/// Contribution cos cos' / r^2 of a part of a light at `place` with this normal.
double received(const glm::dvec3& place, const glm::dvec3& normal) {
  const double square = glm::dot(place, place);
  const double cosines = std::max(place.z, 0.0) * std::max(-glm::dot(normal, place), 0.0);
  return cosines / (square * square);
}

/// Irradiance from a rectangle of radiance 1.
double ofQuad(const glm::dvec3& center, const glm::dvec3& halfX, const glm::dvec3& halfY) {
  const glm::dvec3 normal = glm::normalize(glm::cross(halfX, halfY));
  double sum = 0.0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j)
      sum += received(
          center + (2.0 * (i + 0.5) / steps - 1.0) * halfX + (2.0 * (j + 0.5) / steps - 1.0) * halfY, normal);
  return sum * 4.0 * glm::length(halfX) * glm::length(halfY) / (double(steps) * steps);
}

double ofDisk(const glm::dvec3& center, const glm::dvec3& normal, double radius) {
  const glm::dvec3 u = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.5, 0.8))),
                   v = glm::cross(normal, u);
  double sum = 0.0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double r = radius * (i + 0.5) / steps, turn = 2.0 * pi * j / steps;
      sum += r * received(center + r * (std::cos(turn) * u + std::sin(turn) * v), normal);
    }
  return sum * radius * 2.0 * pi / (double(steps) * steps);
}

/// Irradiance from a sphere of radiance 1, integrated over the directions to it.
double ofSphere(const glm::dvec3& center, double radius) {
  const glm::dvec3 w = glm::normalize(center), u = glm::normalize(glm::cross(w, glm::dvec3(0.3, 0.5, 0.8))),
                   v = glm::cross(w, u);
  const double widest = std::asin(radius / glm::length(center));
  double sum = 0.0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double angle = widest * (i + 0.5) / steps, turn = 2.0 * pi * j / steps;
      const glm::dvec3 way =
          std::cos(angle) * w + std::sin(angle) * (std::cos(turn) * u + std::sin(turn) * v);
      sum += std::sin(angle) * std::max(way.z, 0.0);
    }
  return sum * widest * 2.0 * pi / (double(steps) * steps);
}

TEST(AreaLightShading, SphereAboveTheHorizon_IsMTimesR2CosOverD2) {
  EXPECT_NEAR(shaded(parseLight("area:sphere:0,0,2:0.5:1,1,1")), 0.0625, 2e-4);
  EXPECT_NEAR(shaded(parseLight("area:sphere:3,0,4:2:1,1,1")), 4.0 * 0.8 / 25.0, 2e-4);
}

TEST(AreaLightShading, HalfSunkSphere_IsWhatIsAboveTheHorizon) {
  const double angle = std::asin(0.5);
  EXPECT_NEAR(shaded(parseLight("area:sphere:2,0,0:1:1,1,1")),
              (angle - std::sin(angle) * std::cos(angle)) / pi, 2e-4);
  for (const double z : {-0.5, -0.2, 0.3, 0.9}) {
    Light light = parseLight("area:sphere:1.5,0.5,0:1:1,1,1");
    light.position.z = z;
    EXPECT_NEAR(shaded(light), ofSphere(light.position, 1.0) / pi, 3e-4) << z;
  }
  EXPECT_EQ(shaded(parseLight("area:sphere:0,0,-2:1:1,1,1")), 0.0);
}

TEST(AreaLightShading, PointWithinASphere_IsDark) {
  EXPECT_EQ(shaded(parseLight("area:sphere:0,0,0.2:1:1,1,1")), 0.0);
}

TEST(AreaLightShading, Disk_IsTheIntegralOverIt) {
  EXPECT_NEAR(shaded(parseLight("area:disk:0,0,2:0,0,-1:1:1,1,1")), 0.2, 2e-4);  // R^2 / (R^2 + d^2).
  for (const char* text :
       {"area:disk:1,0.5,1:-1,0,-0.3:0.8:1,1,1", "area:disk:0.6,0,0.1:-1,0.2,0:0.5:1,1,1",
        "area:disk:1,1,-0.2:-0.7,-0.4,-0.6:1:1,1,1", "area:disk:0.2,0.1,0.3:0,0.1,-1:2:1,1,1"}) {
    const Light light = parseLight(text);
    EXPECT_NEAR(shaded(light), ofDisk(light.position, light.direction, light.shape->radius) / pi, 2e-3)
        << text;
  }
}

TEST(AreaLightShading, Quad_IsTheIntegralOverIt) {
  for (const char* text :
       {"area:quad:0,0,2:0,0,-1:1,2:1,1,1", "area:quad:1,0.5,1:-1,0,-0.3:1,1.5:1,1,1:turn=20",
        "area:quad:0.6,0,0.1:-1,0.2,0:1,0.8:1,1,1:turn=45", "area:quad:1,1,-0.2:-0.7,-0.4,-0.6:2,1:1,1,1",
        "area:quad:1,0,0.5:1,0,0:1,1:1,1,1"}) {
    const Light light = parseLight(text);
    const glm::dvec2 corner = light.shape->corners[2];
    const double expected =
        ofQuad(light.position, corner.x * light.side, corner.y * glm::cross(light.direction, light.side)) /
        pi;
    EXPECT_NEAR(shaded(light), expected, 1e-3) << text;
  }
}

TEST(AreaLightShading, Polygon_IsTheSumOfItsParts) {
  const double whole = shaded(parseLight("area:polygon:1,0,1:0,1,1:-1,0,1:0,-1,1:1,1,1"));
  EXPECT_EQ(whole, 0.0) << "counter-clockwise from above: it shines upwards";
  const double facing = shaded(parseLight("area:polygon:0,-1,1:-1,0,1:0,1,1:1,0,1:1,1,1"));
  const double halves = shaded(parseLight("area:polygon:0,-1,1:-1,0,1:0,1,1:1,1,1")) +
                        shaded(parseLight("area:polygon:0,1,1:1,0,1:0,-1,1:1,1,1"));
  EXPECT_NEAR(facing, ofQuad({0, 0, 1}, {-0.5, 0.5, 0}, {0.5, 0.5, 0}) / pi, 1e-3);
  EXPECT_NEAR(facing, halves, 3e-4);
}

TEST(AreaLightShading, PointsOnEdgesAndInPlanesOfLights_AreFinite) {
  for (const char* text :
       {"area:disk:1,0,0:0,0,1:1:1,1,1:two-sided", "area:disk:0,0,0:0,0,-1:1:1,1,1:two-sided",
        "area:disk:0.5,0,0:-1,0,0:0.5:1,1,1:two-sided", "area:quad:0.5,0,0:0,0,1:1,1:1,1,1:two-sided",
        "area:quad:0,0.5,0:0,1,0:1,1:1,1,1:two-sided", "area:polygon:0,0,0:1,0,0:0,1,1:1,1,1:two-sided",
        "area:sphere:0,0,0.5:0.5:1,1,1", "area:sphere:0,0,0:1e-9:1,1,1"}) {
    QuadScene quad;
    Material glossy = lambertian(glm::vec3(0.5f));
    glossy.metallic = 0.5f;
    glossy.roughness = 0.2f;
    quad.add(glossy);
    quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
    quad.setSky(constantEnvironment(glm::vec3(0)));
    quad.scene.lights = {parseLight(text)};
    quad.compile();
    for (const glm::vec3& pixel : quad.render(square()).pixels)
      for (int c = 0; c < 3; ++c) {
        ASSERT_TRUE(std::isfinite(pixel[c])) << text;
        ASSERT_LT(pixel[c], 2.0f) << text;
      }
  }
}

TEST(AreaLightShading, TwoSidedDisk_ShinesBackwardsToo) {
  EXPECT_EQ(shaded(parseLight("area:disk:0,0,2:0,0,1:1:1,1,1")), 0.0);
  EXPECT_NEAR(shaded(parseLight("area:disk:0,0,2:0,0,1:1:1,1,1:two-sided")), 0.2, 2e-4);
}

TEST(AreaLightShading, Outside_ComesThroughTheTransferAsADistantLight) {
  QuadScene quad;
  quad.add(lambertian(glm::vec3(1.0f)));
  quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
  quad.setSky(constantEnvironment(glm::vec3(0)));
  quad.compile();
  quad.bakeOpen(6);
  quad.scene.lights = {parseLight("point:0,0,20:314.159265,314.159265,314.159265")};
  const double point = pixelAt(quad.render(square(Shading::Sh))).x;
  quad.scene.lights = {parseLight("area:disk:0,0,20:0,0,-1:1:100,100,100")};
  EXPECT_GT(point, 0.1);
  // The pixel interpolates vertices at (1, 1). Compared with a point light, they see the disk's cosine, and
  // R^2 / (R^2 + d^2) in place of R^2 / d^2.
  const double less = 20.0 / std::sqrt(402.0) * 402.0 / 403.0;
  EXPECT_NEAR(pixelAt(quad.render(square(Shading::Sh))).x, less * point, 1e-3 * point);
  EXPECT_NEAR(viewer::incidentFrom(viewer::shadedLight(quad.scene.lights[0], quad.compiled), glm::dvec3(0.0))
                  .irradiance.x,
              100.0 * pi / 401.0, 1e-3);
}

/// Radiance that white GGX microfacets facing +Z send to `eye` when directions within `angle` of `towards`
/// have radiance 1.
double ggxReflection(const glm::dvec3& eye, double roughness, const glm::dvec3& towards, double angle) {
  const double a2 = std::pow(roughness, 4.0), nv = eye.z;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < 2 * steps; ++j) {
      const double nl = (i + 0.5) / steps, sine = std::sqrt(1.0 - nl * nl), turn = pi * (j + 0.5) / steps;
      const glm::dvec3 w(sine * std::cos(turn), sine * std::sin(turn), nl), h = glm::normalize(w + eye);
      const double d = h.z * h.z * (a2 - 1.0) + 1.0;
      const double smith =
          nl * std::sqrt(nv * nv * (1.0 - a2) + a2) + nv * std::sqrt(nl * nl * (1.0 - a2) + a2);
      if (glm::dot(w, towards) > std::cos(angle)) sum += nl * 0.5 * a2 / (pi * d * d * smith);
    }
  return sum * pi / (double(steps) * steps);
}

TEST(AreaLightShading, GlossyReflection_IsCloseToTheLobes) {
  for (const float roughness : {0.35f, 0.6f, 1.0f})
    for (const double slope : {0.0, 0.6, 1.5}) {
      const glm::dvec3 eye = glm::normalize(glm::dvec3(slope, 0, 1)), mirrored(-eye.x, 0, eye.z);
      for (const glm::dvec3& towards : {mirrored, glm::normalize(mirrored + glm::dvec3(0, 0.3, 0))}) {
        QuadScene quad;
        Material metal = lambertian(glm::vec3(1.0f));
        metal.metallic = 1.0f;
        metal.roughness = roughness;
        quad.add(metal, 0.05f);
        quad.lookFrom(eye, {0, 0, 0});
        quad.setSky(constantEnvironment(glm::vec3(0)));
        quad.scene.lights = {
            parseLight("area:sphere:0,0,0:" + std::to_string(10.0 * std::sin(0.3)) + ":1,1,1")};
        quad.scene.lights[0].position = 10.0 * towards;
        quad.compile();
        const double expected = ggxReflection(eye, roughness, towards, 0.3);
        EXPECT_NEAR(pixelAt(quad.render(square())).x, expected, 0.2 * expected + 0.01)
            << roughness << " " << slope << " " << towards.y;
      }
    }
}

}  // namespace
}  // namespace prelight

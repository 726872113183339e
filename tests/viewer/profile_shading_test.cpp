// Lamps with profiles (EXT_lights_ies) in OpenGL, compared with double precision.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "charts/make_light_map_layout.h"
#include "gi/global_illumination.h"
#include "scene/light_profile.h"
#include "support/profiles.h"
#include "viewer/lights/lighting.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using namespace test;
using std::numbers::pi;
using viewer::Shading;

std::shared_ptr<const LightProfile> swirl() {
  return makeProfile([](double height, double turn) {
    return 2.0 + std::cos(0.5 * height) * std::sin(turn) + std::cos(height);
  });
}

QuadScene profiledQuad(const Light& light) {
  QuadScene quad;
  quad.add(lambertian(glm::vec3(1.0f)));
  quad.lookFrom({0, 0, 2.5}, {0, 0, 0});
  quad.scene.lights = {light};
  quad.compile();
  return quad;
}

double radianceAtCentre(const Light& light) {
  const glm::dvec3 way = -light.position;
  const double cosine = light.position.z / glm::length(way);
  return profileTowards(light, glm::normalize(way)) * cosine / (pi * glm::dot(way, way));
}

const std::array<glm::dvec3, 3> places = {glm::dvec3(1, 0, 2), glm::dvec3(-0.5, 0.8, 1.5),
                                          glm::dvec3(0.1, -2, 1)};

TEST(ProfileShading, Phong_IsTheProfileTimesTheCosineOverPiR2) {
  for (const glm::dvec3& place : places) {
    const Light light =
        profiledLight(place, swirl(), glm::normalize(glm::dvec3(0.2, 0.3, -1)),
                      glm::normalize(glm::cross(glm::dvec3(0.2, 0.3, -1), glm::dvec3(0, 1, 0.4))));
    const auto expected = static_cast<float>(radianceAtCentre(light));
    expectColor(pixelAt(profiledQuad(light).render(square())), glm::vec3(expected), 2e-3);
  }
}

TEST(ProfileShading, Full_IsTheSame) {
  for (const glm::dvec3& place : places) {
    const Light light = profiledLight(place, swirl(), {0, 0, -1}, {0.6, 0.8, 0});
    const QuadScene quad = profiledQuad(light);
    GlobalIllumination dark;
    LightMapLayoutRequest request;
    request.texels = 500;
    dark.indirect.layout = makeLightMapLayout(quad.scene, quad.compiled, request);
    dark.indirect.values.assign(3 * dark.indirect.layout.texelCount(), 0.0f);
    viewer::RenderInputs inputs = quad.inputs();
    inputs.globalIllumination = &dark;
    viewer::RenderOptions options = square(Shading::GlobalIllumination, 65);
    options.samplesPerAxis = 1;
    Warnings notes;
    const auto expected = static_cast<float>(radianceAtCentre(light));
    expectColor(pixelAt(viewer::renderPicture(inputs, options, notes)), glm::vec3(expected), 1e-2);
  }
}

TEST(ProfileShading, SeenFromAfar_CountsWithWhatItSendsThere) {
  const Light light = profiledLight({3, 4, 5}, swirl(), {0, 0, -1}, {0.6, 0.8, 0});
  const QuadScene quad = profiledQuad(light);
  const IncidentLight incident = incidentFrom(viewer::shadedLight(light, quad.compiled), glm::dvec3(0.0));
  EXPECT_NEAR(incident.irradiance.x, profileTowards(light, glm::normalize(glm::dvec3(-3, -4, -5))) / 50.0,
              1e-6);
}

}  // namespace
}  // namespace prelight

// Spot lights that project pictures, compared with the geometry of their images on a wall.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>

#include "prelight/error.h"
#include "scene/light_profile.h"
#include "support/gltf_files.h"
#include "viewer/lights/illumination.h"
#include "viewer/options/lamp_files.h"
#include "viewer/options/light_fields.h"
#include "viewer/options/light_option.h"
#include "viewer/picture_checks.h"
#include "viewer/quad_scene.h"

namespace prelight {
namespace {

using namespace test;
using std::numbers::pi;
using viewer::Shading;

/// Red and green above, blue and white below.
std::shared_ptr<const Picture> fourColours() {
  return std::make_shared<const Picture>(Picture{2, 2, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}});
}

/// A projector at (0, 0, 2) that covers [-2, 2]^2 of a wall at z = 0.
Light projector(std::shared_ptr<const Picture> cookie, double turn = 0.0) {
  Light light = viewer::parseLight("spot:0,0,2:0,0,-1:45,45:1,1,1");
  light.side = viewer::levelSide(light.direction, turn);
  light.cookie = std::move(cookie);
  return light;
}

/// A white wall as seen from the projector, 4 m wide.
Picture wallUnder(const Light& light, Shading shading = Shading::Phong) {
  QuadScene quad;
  quad.add(lambertian(glm::vec3(1.0f)), 2.0f);
  quad.lookFrom({0, 0, 4}, {0, 0, 0});
  quad.setSky(constantEnvironment(glm::vec3(0)));
  quad.scene.lights = {light};
  quad.compile();
  return quad.render(square(shading, 101));
}

/// Picture at a place on the wall.
glm::vec3 seenAt(const Picture& picture, double x, double y) {
  const double half = 4.0 * std::tan(0.5 * 0.785398163);  // The camera's field of view.
  return pixelAt(picture, 0.5 + 0.5 * x / half, 0.5 - 0.5 * y / half);
}

double evenRadiance(double x, double y) {
  const double square = x * x + y * y + 4.0;
  return 2.0 / (square * std::sqrt(square) * pi);
}

TEST(CookieShading, Picture_IsUprightAndNotMirroredSeenFromTheLamp) {
  const Picture wall = wallUnder(projector(fourColours()));
  const std::array<std::pair<glm::dvec2, glm::vec3>, 4> parts = {{{{-1.2, 1.2}, {1, 0, 0}},
                                                                  {{1.2, 1.2}, {0, 1, 0}},
                                                                  {{-1.2, -1.2}, {0, 0, 1}},
                                                                  {{1.2, -1.2}, {1, 1, 1}}}};
  for (const auto& [place, color] : parts)
    expectColor(seenAt(wall, place.x, place.y), evenRadiance(place.x, place.y) * glm::dvec3(color), 0.04);
}

TEST(CookieShading, Turned_IsTurnedAboutTheDirection) {
  const Picture wall = wallUnder(projector(fourColours(), 90.0));
  // Right-handed about -Z: clockwise as seen on the wall.
  expectColor(seenAt(wall, 1.2, 1.2), evenRadiance(1.2, 1.2) * glm::dvec3(1, 0, 0), 0.04);
  expectColor(seenAt(wall, -1.2, 1.2), evenRadiance(1.2, 1.2) * glm::dvec3(0, 0, 1), 0.04);
}

TEST(CookieShading, BetweenTexels_IsBilinear_AndTheConeStillCounts) {
  const Picture wall = wallUnder(projector(fourColours()));
  expectColor(seenAt(wall, 0, 0), evenRadiance(0, 0) * glm::dvec3(0.5), 0.03);
  expectColor(seenAt(wall, 0.5, 1.3), evenRadiance(0.5, 1.3) * glm::dvec3(0.25, 0.75, 0), 0.05);
  EXPECT_EQ(seenAt(wall, 1.6, 1.6), glm::vec3(0.0f));
}

TEST(CookieShading, SeenFromAfar_CountsWithWhatItSendsThere) {
  QuadScene quad;
  quad.add(lambertian(glm::vec3(1.0f)));
  quad.compile();
  Light light = projector(fourColours());
  light.position = {2, -2, 8};  // The centre is above and to the left, with a quarter of the irradiance.
  const IncidentLight incident = incidentFrom(viewer::shadedLight(light, quad.compiled), glm::dvec3(0.0));
  const double u = 0.5 * (1.0 - 0.25) * 2.0 - 0.5, v = 0.5 * (1.0 - 0.25) * 2.0 - 0.5;
  EXPECT_NEAR(incident.irradiance.r, ((1 - u) * (1 - v) + u * v) / 72.0, 1e-6);
  EXPECT_NEAR(incident.irradiance.g, (u * (1 - v) + u * v) / 72.0, 1e-6);
  EXPECT_NEAR(incident.irradiance.b, ((1 - u) * v + u * v) / 72.0, 1e-6);
}

TEST(Cookie, LargePicture_IsAveragedAndLosesWhatIsNoLight) {
  Picture large{512, 300, std::vector<glm::vec3>(512 * 300, glm::vec3(1.0f, -1.0f, INFINITY))};
  for (std::size_t i = 0; i < large.pixels.size(); i += 2) large.pixels[i].r = 3.0f;
  const Picture cookie = cookieOf(large);
  EXPECT_EQ(cookie.width, 256);
  EXPECT_EQ(cookie.height, 150);
  for (const glm::vec3& texel : cookie.pixels) ASSERT_EQ(texel, glm::vec3(2, 0, 0));
  EXPECT_EQ(cookieMean(cookie), glm::dvec3(2, 0, 0));
}

class LampFiles : public ::testing::Test {
 protected:
  const TemporaryFolder folder_;
};

TEST_F(LampFiles, ProfileAndCookie_AreReadWithTheLight) {
  const std::filesystem::path ies = folder_ / "even.ies", png = folder_ / "one.png";
  std::ofstream(ies)
      << "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 10\n0 90 180\n0\n50 30 10\n";
  writePicture(png, Picture{1, 1, {{1, 1, 1}}});
  const Light lamp = viewer::parseLight("point:1,2,3:2,2,2:profile=" + ies.string() + ":aim=0,0,-1:turn=90");
  ASSERT_NE(lamp.profile, nullptr);
  EXPECT_EQ(lamp.profile->values.front(), 50.0);
  EXPECT_EQ(lamp.direction, glm::dvec3(0, 0, -1));
  EXPECT_NEAR(std::abs(lamp.side.y), 1.0, 1e-12);
  EXPECT_EQ(lamp.position, glm::dvec3(1, 2, 3));
  const Light slide = viewer::parseLight("spot:0,0,2:0,0,-1:20,30:1,1,1:cookie=" + png.string());
  ASSERT_NE(slide.cookie, nullptr);
  EXPECT_EQ(slide.cookie->width, 1);
  EXPECT_THROW(viewer::parseLight("point:0,0,0:1,1,1:profile=" + png.string()), InputError);
  EXPECT_THROW(viewer::parseLight("spot:0,0,2:0,0,-1:20,30:1,1,1:cookie=nowhere.png"), InputError);
}

TEST_F(LampFiles, LiveLightWithAProfile_IsDrawnWithIt) {
  const std::filesystem::path ies = folder_ / "cone.ies";
  std::ofstream(ies)
      << "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 10\n0 90 180\n0\n50 30 10\n";
  const Light lamp = viewer::parseLight("point:0,0,2:1,1,1:profile=" + ies.string() + ":aim=0,0,-1");
  expectColor(seenAt(wallUnder(lamp), 0, 0), glm::dvec3(50.0 / (4.0 * pi)), 5e-3);
  const Light sideways = viewer::parseLight("point:0,0,2:1,1,1:profile=" + ies.string() + ":aim=0,1,0");
  expectColor(seenAt(wallUnder(sideways), 0, 0), glm::dvec3(30.0 / (4.0 * pi)), 5e-3);
}

}  // namespace
}  // namespace prelight

#include <gmock/gmock.h>

#include "cli/cli_test.h"
#include "support/made_scenes.h"

namespace prelight::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Messages about light that arrives nowhere, and about the sides of surfaces.
class CliDarkness : public CliTest {
 protected:
  static constexpr glm::vec3 low{-2.0f, 0.0f, -2.0f}, high{2.0f, 3.0f, 2.0f};

  void write(const std::string& name, SceneMaker&& maker) const {
    maker.addCamera({1.0, 1.5, 1.8});
    save(path(name), maker.make());
  }

  /// Writes a closed room whose lamp is in an opaque bulb. With `more`, another lamp is beside it.
  void writeBulb(const std::string& name, bool more) const {
    SceneMaker maker;
    maker.add("room", box(2, low, high, true)).add("bulb", sphere(8, 0.05f, {0.0f, 2.5f, 0.0f}));
    maker.addLamp({0.0, 2.5, 0.0});
    if (more) maker.addLamp({1.0, 1.0, 0.0});
    write(name, std::move(maker));
  }
};

TEST_F(CliDarkness, LampInABulb_IsToldByAllThatIsLitByIt) {
  writeBulb("bulb.glb", false);
  const auto tells = AllOf(HasSubstr("black all over"), HasSubstr("\"Lamp\""), HasSubstr("\"bulb\""));
  for (const char* technique : {"--radiosity", "--light-groups", "--lightmap"})
    EXPECT_THAT(prelightDone({"bake", "bulb.glb", "-o", "out.glb", technique, "--rays", "8"}).errors, tells)
        << technique;
  EXPECT_THAT(prelightDone({"export", "out.glb", "-o", "exported"}).errors, tells);
  EXPECT_THAT(prelightDone({"reference", "bulb.glb", "-o", "out.exr", "--spp", "4", "--size", "8"}).errors,
              tells);
  EXPECT_THAT(
      prelightDone({"render", "bulb.glb", "-o", "out.exr", "--shading", "full", "--size", "8"}).errors,
      tells);
  const auto info = nlohmann::json::parse(prelightDone({"info", "bulb.glb", "--json"}).output);
  EXPECT_EQ(info.at("contents").at("sides").at("shutInLamps").size(), 1u);
  EXPECT_THAT(prelightDone({"info", "bulb.glb"}).output, HasSubstr("shut in"));
}

TEST_F(CliDarkness, OneShutInLampOfTwo_IsToldBesideALitResult) {
  writeBulb("bulb.glb", true);
  const std::string errors =
      prelightDone({"bake", "bulb.glb", "-o", "out.glb", "--lightmap", "--rays", "8"}).errors;
  EXPECT_THAT(errors, AllOf(HasSubstr("shut in"), Not(HasSubstr("black all over"))));
}

TEST_F(CliDarkness, LitRoom_IsNotWarnedOf) {
  SceneMaker maker;
  maker.add("room", box(2, low, high, true)).addLamp({0.0, 2.0, 0.0});
  write("room.glb", std::move(maker));
  EXPECT_EQ(
      prelightDone({"bake", "room.glb", "-o", "out.glb", "--lightmap", "--rays", "8", "--quiet"}).errors, "");
}

TEST_F(CliDarkness, CameraThatSeesNothing_IsTold) {
  SceneMaker maker;
  maker.add("floor", ground(2, 1.0f, -5.0f)).addLamp({0.0, 2.0, 0.0});
  maker.addCamera({0.0, -9.0, 0.0});  // Looks along -z, below the floor.
  save(path("away.glb"), maker.make());
  EXPECT_THAT(prelightDone({"reference", "away.glb", "-o", "out.exr", "--spp", "2", "--size", "8"}).errors,
              HasSubstr("sees no surface"));
}

TEST_F(CliDarkness, RoomOfOutwardNormals_IsToldAndTaken) {
  SceneMaker maker;
  maker.add("room", box(2, low, high, false)).addLamp({0.0, 2.0, 0.0});
  write("room.glb", std::move(maker));
  const auto tells = AllOf(HasSubstr("seen from behind"), HasSubstr("\"room\""), HasSubstr("double-sided"));
  EXPECT_THAT(prelightDone({"bake", "room.glb", "-o", "out.glb", "--radiosity", "--rays", "8"}).errors,
              tells);
  EXPECT_THAT(prelightDone({"info", "room.glb"}).output,
              HasSubstr("100 % of the surface is seen from behind"));
  const auto info = nlohmann::json::parse(prelightDone({"info", "room.glb", "--json"}).output);
  EXPECT_EQ(info.at("contents").at("sides").at("seenFromBehind"), 1.0);
}

}  // namespace
}  // namespace prelight::test

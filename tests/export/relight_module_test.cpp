#include "export/relight_module.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "basis/ch.h"
#include "basis/sh_projection.h"
#include "basis/sh_rotation.h"
#include "basis/sh_zonal.h"
#include "compress/quantized_numbers.h"
#include "images/sky_lamps.h"
#include "support/disk_skies.h"
#include "support/gltf_files.h"
#include "support/installed_programs.h"

namespace prelight {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

constexpr int skyOrder = 5;

/// Runs statements in node that know the module as `module` and `input`, and returns what they say().
class Module : public ::testing::Test {
 protected:
  void SetUp() override { SKIP_WITHOUT("node"); }

  Json said(const std::string& statements, const Json& input) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "prelight.mjs") << relightModule();
    std::ofstream(folder / "input.json") << input.dump();
    std::ofstream(folder / "test.mjs")
        << "import * as module from './prelight.mjs';\nimport { readFileSync } from 'node:fs';\n"
           "const input = JSON.parse(readFileSync(process.argv[2]));\n"
           "const say = value => console.log(JSON.stringify(value, (key, v) => ArrayBuffer.isView(v) ? "
           "[...v] : v));\n"
        << statements << "\n";
    const std::string out = (folder / "out.json").string();
    const std::string command =
        "node " + (folder / "test.mjs").string() + " " + (folder / "input.json").string() + " > " + out;
    EXPECT_EQ(std::system(command.c_str()), 0);
    return Json::parse(test::readBytes(out));
  }
};

/// An uneven sky with a small bright disk.
Environment skyWithSun(int width) {
  Environment sky{width, width / 2, {}};
  for (int row = 0; row < sky.height; ++row)
    for (int column = 0; column < sky.width; ++column) {
      const double u = (column + 0.5) / sky.width, v = (row + 0.5) / sky.height;
      const glm::dvec3 w = Environment::direction(u, v);
      const bool isSun = glm::dot(w, glm::normalize(glm::dvec3(0.3, 0.5, -0.8))) > std::cos(0.02);
      sky.radiance.emplace_back(glm::vec3(isSun ? 2000.0 : 0.4 + 0.3 * w.y, isSun ? 1500.0 : 0.5 + 0.2 * w.x,
                                          isSun ? 1000.0 : 0.6 - 0.3 * w.z));
    }
  return sky;
}

Json jsonOf(const Environment& sky) {
  Json colors = Json::array();
  for (const glm::vec3& texel : sky.radiance)
    for (int c = 0; c < 3; ++c) colors.push_back(texel[c]);
  return {{"width", sky.width}, {"height", sky.height}, {"colors", colors}};
}

/// [i] RGB.
Json jsonOf(std::span<const double> channels) {
  const std::size_t count = channels.size() / 3;
  Json numbers = Json::array();
  for (std::size_t i = 0; i < count; ++i)
    numbers.push_back({channels[i], channels[count + i], channels[2 * count + i]});
  return numbers;
}

void expectNear(const Json& found, std::span<const double> expected, double tolerance) {
  const std::size_t count = expected.size() / 3;
  ASSERT_EQ(found.size(), count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(found[i][c].get<double>(), expected[c * count + i], tolerance) << i << " " << c;
}

const char* const givenSky = "const sky = { ...input, colors: Float32Array.from(input.colors) };\n";

TEST_F(Module, Sky_HasTheCoefficientsOfTheLibrary) {
  const Environment sky = skyWithSun(32);
  const std::vector<double> expected = sh::projectEnvironment(sky, skyOrder);
  expectNear(said(std::string(givenSky) + "say(module.projectedSky(sky, 5));", jsonOf(sky)), expected,
             1e-4 * expected[0]);
}

TEST_F(Module, Lamps_AreTakenOutAsTheLibraryDoes) {
  Environment sky = skyWithSun(256);
  const glm::dvec3 towards = glm::normalize(glm::dvec3(-1.0, 0.5, 1.0));
  test::addDisk(sky, towards, 0.1, {30.0f, 20.0f, 10.0f});
  const LampsAndSky expected = takeLampsOut(sky);
  ASSERT_EQ(expected.lamps.size(), 2u);
  const Json found = said(std::string(givenSky) +
                              "const { lamps, rest } = module.withoutItsLamps(sky);\n"
                              "say({ lamps, most: Math.max(...rest.colors) });",
                          jsonOf(sky));
  ASSERT_EQ(found["lamps"].size(), expected.lamps.size());
  for (std::size_t i = 0; i < expected.lamps.size(); ++i) {
    const SkyLamp& lamp = expected.lamps[i];
    const Json& seen = found["lamps"][i];
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(seen["direction"][c].get<double>(), lamp.direction[c], 1e-6);
      EXPECT_NEAR(seen["irradiance"][c].get<double>(), lamp.irradiance[c], 1e-4 * lamp.irradiance[c]);
    }
    EXPECT_NEAR(seen["radius"].get<double>(), lamp.radius, 1e-6);
  }
  EXPECT_LT(found["most"].get<double>(), 1.0);
  EXPECT_TRUE(said(std::string(givenSky) + "say(module.withoutItsLamps(sky).lamps);",
                   jsonOf(Environment{64, 32, std::vector<glm::vec3>(64 * 32, glm::vec3(1.0f))}))
                  .empty());
}

/// A panel is brighter than the disk elsewhere, and its middle is no lamp.
TEST_F(Module, Lamps_DimmerThanAPanel_AreTakenOutAsTheLibraryDoes) {
  Environment sky{128, 64, {}};
  for (int row = 0; row < sky.height; ++row)
    for (int column = 0; column < sky.width; ++column) {
      const glm::dvec3 w = Environment::direction((column + 0.5) / sky.width, (row + 0.5) / sky.height);
      const bool ofPanel = w.z < 0.0 && std::max(std::abs(w.x), std::abs(w.y)) < 0.47;
      sky.radiance.emplace_back(ofPanel ? 110.0f : w.z > std::cos(0.14) ? 100.0f : 0.1f);
    }
  const std::vector<SkyLamp> expected = takeLampsOut(sky).lamps;
  ASSERT_FALSE(expected.empty());
  EXPECT_GT(expected.back().direction.z, std::cos(0.01)) << "the disk";
  const Json found = said(std::string(givenSky) + "say(module.withoutItsLamps(sky).lamps);", jsonOf(sky));
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(found[i]["direction"][c].get<double>(), expected[i].direction[c], 1e-6);
}

TEST_F(Module, Smoothing_IsTheWeakestThatLeavesNothingNegative) {
  const std::vector<double> sky = sh::projectEnvironment(skyWithSun(64), skyOrder);
  const double expected = sh::minimalWindow(sky, skyOrder).lambda;
  ASSERT_GT(expected, 0.0);
  EXPECT_NEAR(said("say(module.smoothingOf(input, 5));", jsonOf(sky)).get<double>(), expected,
              0.05 * expected);
}

TEST_F(Module, Turns_AreThoseOfTheLibrary) {
  const std::vector<double> sky = sh::projectEnvironment(skyWithSun(64), skyOrder);
  std::vector<double> expected(sky.size());
  const double angle = 0.7;
  const glm::dmat3 turn({std::cos(angle), 0.0, -std::sin(angle)}, {0.0, 1.0, 0.0},
                        {std::sin(angle), 0.0, std::cos(angle)});
  sh::ShRotation(skyOrder, turn).apply(sky, expected);
  expectNear(said("say(module.turnedAboutY(input, 0.7, 5));", jsonOf(sky)), expected, 1e-9 * sky[0]);
  const glm::dmat3 tilt({1.0, 0.0, 0.0}, {0.0, 0.8, 0.6}, {0.0, -0.6, 0.8}), both = tilt * turn;
  sh::ShRotation(skyOrder, both).apply(sky, expected);
  Json columns = Json::array();
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) columns.push_back(both[column][row]);
  expectNear(said("say(module.turnedBy(input.numbers, input.rotation, 5));",
                  {{"numbers", jsonOf(sky)}, {"rotation", columns}}),
             expected, 1e-9 * sky[0]);
}

TEST_F(Module, MomentsOfCh_AreThoseOfTheLibrary) {
  const std::vector<double> sky = sh::projectEnvironment(skyWithSun(64), skyOrder);
  std::vector<double> expected(sky.size());
  const ch::Basis basis(skyOrder);
  for (std::size_t c = 0; c < 3; ++c)
    basis.momentsFromSh(std::span(sky).subspan(c * skyOrder * skyOrder, skyOrder * skyOrder),
                        std::span(expected).subspan(c * skyOrder * skyOrder, skyOrder * skyOrder));
  expectNear(said("say(module.momentsOfLight(input, module.chBasisOf(5), 5));", jsonOf(sky)), expected,
             1e-6 * sky[0]);
}

TEST_F(Module, OpenReceivers_SeeWhatTheLibrarySays) {
  const Json found =
      said("say([-0.9, -0.2, 0, 0.3, 1].map(cosine => module.openTowards(cosine, 5)));", nullptr);
  std::size_t at = 0;
  for (const double cosine : {-0.9, -0.2, 0.0, 0.3, 1.0})
    EXPECT_NEAR(found[at++].get<double>(), sh::openTowards(cosine, skyOrder), 1e-12);
}

/// Returns bytes as they are in an accessor of their kind.
Json codesOf(const QuantizedNumbers& numbers) {
  Json codes = Json::array();
  for (const std::uint8_t byte : numbers.bytes)
    codes.push_back(numbers.form.isSigned ? static_cast<std::int8_t>(byte) : static_cast<int>(byte));
  return codes;
}

TEST_F(Module, ColumnsOfBytes_HaveTheNumbersOfTheLibrary) {
  const std::vector<float> numbers{0.0f, -0.3f, 0.7f, 1.0f, 12.0f, -40.0f, 0.002f, 7.0f};
  for (const ByteForm& form : {ByteForm{.group = 4}, ByteForm{.square = true, .group = 2},
                               ByteForm{.scale = 40.0f}, accessibilityForm}) {
    const QuantizedNumbers quantized = *quantize(numbers, form);
    Json column = {{"bytes", 0}, {"square", form.square}};
    if (quantized.scales.empty())
      column["scale"] = form.scale;
    else
      column["scales"] = 1;
    const Json found = said(
        "const arrays = [(input.isSigned ? Int8Array : Uint8Array).from(input.codes), "
        "Uint16Array.from(input.scales)];\n"
        "const parser = { json: { extensions: { PRELIGHT_transfer: {} } }, getDependency: async (kind, i) => "
        "({ array: arrays[i] }) };\n"
        "say(await new module.BakedFile(parser).values(input.column));",
        {{"column", column},
         {"codes", codesOf(quantized)},
         {"scales", quantized.scales},
         {"isSigned", form.isSigned}});
    const std::vector<float> expected = dequantize(quantized);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(found[i].get<float>(), expected[i], 1e-6f * std::abs(expected[i])) << i;
  }
}

TEST_F(Module, EntriesWithBytes_HaveWhatTheyStandFor) {
  const Json found = said(
      "const primitives = [{ shCompressed: { bytes: 3 }, quantized: { ch: { order: 3 }, through: {} } }];\n"
      "const json = { extensions: { PRELIGHT_transfer: {} }, nodes: [{ extensions: { PRELIGHT_transfer: { "
      "primitives } } }] };\n"
      "const [entry] = new module.BakedFile({ json }).entriesOf(0);\n"
      "say([entry.shCompressed.bytes, entry.ch.order, Boolean(entry.through)]);",
      nullptr);
  EXPECT_EQ(found, Json({3, 3, true}));
}

/// Uniform blocks hold 240 lights.
TEST_F(Module, LampsOfTheSky_HaveRoomAmongManyLights) {
  const Json found = said(
      "const own = [...Array(230).fill({}), ...Array(10).fill({ isSample: true })], sky = { ofSky: true };\n"
      "const all = module.withLampsOfSky(own, Array(6).fill(sky));\n"
      "say([all.length, all.findIndex(({ ofSky }) => ofSky), all.filter(({ isSample }) => "
      "isSample).length]);",
      nullptr);
  EXPECT_EQ(found, Json({240, 230, 4}));
}

TEST(RelightModule, Text_NeedsNothingElse) {
  const std::string text = relightModule();
  EXPECT_THAT(text, Not(HasSubstr("import ")));
  EXPECT_THAT(text, HasSubstr("export {"));
  EXPECT_THAT(text, Not(HasSubstr("fetch(")));
}

/// Shaders include one another: each text that one names is in the module, but for the variant, which the
/// module writes.
TEST(RelightModule, Shaders_AreThereWithAllThatTheyInclude) {
  for (const auto& [name, text] : relightShaders()) {
    for (std::size_t at = text.find("#include \""); at != std::string::npos;
         at = text.find("#include \"", at + 1)) {
      const std::size_t first = at + 10;
      const std::string included = text.substr(first, text.find('"', first) - first);
      EXPECT_TRUE(included == "variant.glsl" || relightShaders().contains(included))
          << name << " includes " << included;
    }
  }
}

}  // namespace
}  // namespace prelight

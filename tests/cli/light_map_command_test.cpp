#include <gmock/gmock.h>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

using ::testing::HasSubstr;

/// A floor under a roof with a point light.
class CliLightMap : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("scene.glb", floorAndRoof().bytes());
  }

  ProcessResult bake(const std::string& output, const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"bake", "scene.glb", "-o", output, "--lightmap"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return prelightDone(arguments);
  }
};

TEST_F(CliLightMap, Bake_WritesCoordinatesAndAPicture) {
  const ProcessResult result = bake("out.glb", {"--texel-size", "0.1", "--report", "report.json"});
  EXPECT_THAT(result.output, HasSubstr("light map"));
  const GlbScene scene = parseGlb(readFile("out.glb"));
  for (std::size_t node = 0; node < 2; ++node) {
    const auto& entry =
        scene.json.at("nodes").at(node).at("extensions").at("PRELIGHT_transfer").at("primitives").at(0);
    EXPECT_EQ(entry.size(), 2u);
    EXPECT_FALSE(floatAccessor(scene, entry.at("irradiance")).empty());
    EXPECT_EQ(entry.at("lightmap").at("image"), "out.lightmap.exr");
    for (const float value : floatAccessor(scene, entry.at("lightmap").at("texCoord"))) {
      EXPECT_GE(value, 0.0f);
      EXPECT_LE(value, 1.0f);
    }
  }
  const auto report = nlohmann::ordered_json::parse(readFile("report.json"));
  EXPECT_GT(report.at("lightMap").at("texels"), 10);
  EXPECT_EQ(report.at("options").at("texelSize"), 0.1);
  EXPECT_FALSE(readFile("out.lightmap.exr").empty());
}

TEST_F(CliLightMap, Report_RepeatsTheMapsOptions) {
  bake("out.glb", {"--texel-size", "0.5", "--photons", "1000", "--caustics", "--report", "report.json"});
  const auto report = nlohmann::ordered_json::parse(readFile("report.json"));
  const auto& options = report.at("options");
  EXPECT_EQ(options.at("lightmap"), true);
  EXPECT_EQ(options.at("texelSize"), 0.5);
  EXPECT_EQ(options.at("photons"), 1000);
  EXPECT_EQ(options.at("caustics"), true);
  EXPECT_EQ(options.at("denoise"), false);
  EXPECT_EQ(options.at("sky"), false);
}

TEST_F(CliLightMap, TexelError_ChoosesSizesAndSaysSo) {
  const auto reportOf = [&](const std::string& error) {
    const ProcessResult result = bake("out.glb", {"--texel-error", error, "--report", "report.json"});
    EXPECT_THAT(result.output, HasSubstr("expected error between them"));
    return nlohmann::ordered_json::parse(readFile("report.json"));
  };
  const auto coarse = reportOf("0.2"), fine = reportOf("0.05");
  EXPECT_EQ(fine.at("options").at("texelError"), 0.05);
  EXPECT_LT(coarse.at("lightMap").at("texels"), fine.at("lightMap").at("texels"));
  const auto& sizes = fine.at("lightMap").at("texelSizes");
  EXPECT_LT(sizes.at("smallest"), sizes.at("largest"));
  EXPECT_LT(sizes.at("expectedError"), 0.07);
  for (const auto& pass : fine.at("plan").at("passes"))
    if (pass.at("name") == "texel sizes") {
      EXPECT_TRUE(pass.at("runs"));
    }
  // With --texel-error, --texel-size is the size of the smallest texels.
  const auto limited = [&] {
    bake("out.glb", {"--texel-error", "0.01", "--texel-size", "0.2", "--report", "report.json"});
    return nlohmann::ordered_json::parse(readFile("report.json"));
  }();
  EXPECT_GE(limited.at("lightMap").at("texelSizes").at("smallest"), 0.2);
}

TEST_F(CliLightMap, SameSeed_SameBytes) {
  bake("a.glb", {"--texel-size", "0.1"});
  bake("b.glb", {"--texel-size", "0.1"});
  EXPECT_EQ(readFile("a.lightmap.exr"), readFile("b.lightmap.exr"));
  const ProcessResult same = prelightDone({"compare", "a.glb", "b.glb"});
  EXPECT_THAT(same.output, HasSubstr("lightMap"));
  EXPECT_THAT(same.output, HasSubstr("rmse 0,"));
}

TEST_F(CliLightMap, Info_SaysWhatItWouldDoAndWhatAFileCarries) {
  EXPECT_THAT(prelightDone({"info", "scene.glb", "--lightmap", "--texel-size", "0.5"}).output,
              HasSubstr("texels of 0.5 m"));
  bake("out.glb", {"--texel-size", "0.1"});
  EXPECT_THAT(prelightDone({"info", "out.glb"}).output, HasSubstr("light map of"));
}

TEST_F(CliLightMap, LostPicture_IsABadInput) {
  bake("out.glb", {"--texel-size", "0.1"});
  std::filesystem::remove(path("out.lightmap.exr"));
  expectFailure(badInput, {"compare", "out.glb", "out.glb"},
                {"out.lightmap.exr", "no such file", "together"});
}

TEST_F(CliLightMap, BadOptions_AreUsageErrors) {
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "x.glb", "--lightmap", "--texel-size", "0"},
                {"--texel-size"});
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "x.glb", "--texel-size", "1"}, {"--lightmap"});
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "x.glb", "--lightmap", "--texel-size", "1e-6"},
                {"--texel-size", "4096", "or more"});
}

TEST_F(CliLightMap, Caustics_BringALightMapWithThem) {
  prelightDone({"scene", "caustics", "-o", "scene.glb"});
  const auto report =
      nlohmann::json::parse(prelightDone({"bake", "scene.glb", "-o", "baked.glb", "--caustics", "--photons",
                                          "5000", "--texel-size", "0.2", "--rays", "64", "--json"})
                                .output);
  std::size_t runs = 0;
  for (const nlohmann::json& pass : report["plan"]["passes"])
    for (const char* name : {"light map", "indirect light of the map", "caustics of the map"})
      runs += pass["name"] == name && pass["runs"].get<bool>();
  EXPECT_EQ(runs, 3u);
  EXPECT_GT(readFile("baked.lightmap.exr").size(), 1000u);
  expectFailure(2, {"bake", "scene.glb", "-o", "b.glb", "--ao", "--photons", "5000"},
                {"--photons", "--lightmap"});
}

TEST_F(CliLightMap, Compare_TellsEncodingsApart) {
  for (const auto& [name, seed] : {std::pair{"a.glb", "1"}, std::pair{"b.glb", "2"}})
    bake(name, {"--texel-size", "0.2", "--seed", seed, "--encode", "sh-3,ambient-cube"});
  bake("c.glb", {"--texel-size", "0.2", "--seed", "1", "--encode", "ambient-cube"});
  const auto compare = [&](const char* a, const char* b) {
    return nlohmann::json::parse(prelightDone({"compare", a, b, "--json"}).output);
  };
  const nlohmann::json same = compare("a.glb", "a.glb"), other = compare("a.glb", "b.glb");
  for (const char* part :
       {"vertices.sh-3", "vertices.ambient-cube", "lightMap.sh-3", "lightMap.ambient-cube"}) {
    EXPECT_EQ(same.at(part).at("max"), 0.0) << part;
    EXPECT_GT(same.at(part).at("values"), 0) << part;
    EXPECT_GT(other.at(part).at("rmse"), 0.0) << part;
  }
  const nlohmann::json fewer = compare("a.glb", "c.glb");
  EXPECT_FALSE(fewer.contains("vertices.sh-3"));
  EXPECT_EQ(fewer.at("vertices.ambient-cube").at("max"), 0.0);
}

/// The header of an .exr holds the names of all channels.
TEST_F(CliLightMap, Encode_StoresLightAtTexelsAndVertices) {
  bake("out.glb",
       {"--texel-size", "0.2", "--rays", "16", "--encode", "sh-3,ambient-cube", "--report", "report.json"});
  const GlbScene scene = parseGlb(readFile("out.glb"));
  const auto& entry =
      scene.json.at("nodes").at(0).at("extensions").at("PRELIGHT_transfer").at("primitives").at(0);
  const auto& light = entry.at("encodedLight");
  ASSERT_EQ(light.size(), 2u);
  EXPECT_EQ(light.at(0).at("encoding"), "sh-3");
  EXPECT_EQ(light.at(1).at("encoding"), "ambient-cube");
  const std::size_t vertices = floatAccessor(scene, entry.at("irradiance")).size() / 3;
  EXPECT_EQ(floatAccessor(scene, light.at(0).at("values")).size(), 27 * vertices);
  EXPECT_EQ(floatAccessor(scene, light.at(1).at("values")).size(), 18 * vertices);
  const std::string picture = readFile("out.lightmap.exr");
  for (const char* channel : {"encoded.sh-3.026", "encoded.ambient-cube.017"})
    EXPECT_NE(picture.find(channel), std::string::npos) << channel;
  const auto report = nlohmann::ordered_json::parse(readFile("report.json"));
  EXPECT_EQ(report.at("options").at("encode"), "sh-3,ambient-cube");
  const std::string info = prelightDone({"info", "out.glb"}).output;
  EXPECT_THAT(info, HasSubstr("ambient-cube, 18 numbers"));
  EXPECT_THAT(info, Not(HasSubstr("encoded light: ")));
  EXPECT_THAT(prelightDone({"info", "scene.glb", "--lightmap", "--encode", "sh-3"}).output,
              HasSubstr("encoded light: incident radiance"));
}

TEST_F(CliLightMap, EncodeOfNoEncoding_IsAUsageError) {
  const std::vector<std::string> arguments = {"bake", "scene.glb", "-o", "x.glb", "--lightmap", "--encode"};
  const auto refused = [&](const std::string& names, const std::vector<std::string>& words) {
    std::vector<std::string> all = arguments;
    all.push_back(names);
    expectFailure(badUsage, all, words);
  };
  refused("ambient-cub", {"--encode ambient-cub", "did you mean ambient-cube", "sh-3"});
  refused("sh-3,sh-3", {"--encode", "sh-3", "twice"});
  refused(",", {"--encode", "one of", "ambient-cube"});
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "x.glb", "--encode", "sh-3"},
                {"--encode", "--lightmap"});
  expectFailure(badUsage, {"bake", "scene.glb", "-o", "x.glb", "--ao", "--encode", "sh-3"},
                {"--encode", "--lightmap"});
}

/// A new picture beside the old file would be from a different bake than the file.
TEST_F(CliLightMap, DiskWithRoomForThePictureAlone_LeavesBothFilesAsTheyWere) {
  const std::vector<std::string> coarse = {"--sh", "8", "--rays", "16", "--texel-size", "0.5"};
  bake("out.glb", coarse);
  const std::string file = readFile("out.glb"), picture = readFile("out.lightmap.exr");
  const std::size_t limit = picture.size() / 1024 + 1;
  ASSERT_LT(limit * 1024, file.size());
  const std::set<std::string> before = files();
  const ProcessResult result =
      runProcess({"/bin/bash", "-c",
                  "ulimit -f " + std::to_string(limit) +
                      "; $P bake scene.glb -o out.glb --lightmap --sh 8 --rays 16 --texel-size 0.5 --seed 9"},
                 {.directory = path(""), .environment = {{"P", PRELIGHT_PROGRAM}}});
  EXPECT_EQ(result.exitCode, 1) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("out.glb: cannot write"));
  EXPECT_EQ(readFile("out.glb"), file);
  EXPECT_EQ(readFile("out.lightmap.exr"), picture);
  EXPECT_EQ(files(), before);
}

}  // namespace
}  // namespace prelight::test

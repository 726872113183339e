#include <gmock/gmock.h>
#include <unistd.h>

#include <set>

#include "cli/cli_test.h"
#include "cli/glb_scene.h"

namespace prelight::test {
namespace {

constexpr int noDevice = 4;

class CliOutput : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    writeFile("scene.glb", floorAndRoof().bytes());
  }
};

TEST_F(CliOutput, Folder_Missing_IsNamedBeforeTheBake) {
  expectFailure(failed, {"bake", "scene.glb", "-o", "nowhere/out.glb"}, {"-o nowhere/out.glb", "nowhere"});
  expectFailure(failed, {"bake", "scene.glb", "-o", "out.glb", "--report", "nowhere/r.json"}, {"--report"});
  expectFailure(failed, {"render", "scene.glb", "-o", "nowhere/out.png"}, {"-o nowhere/out.png"});
  expectFailure(failed, {"scene", "shapes", "-o", "nowhere/out.glb"}, {"-o nowhere/out.glb"});
}

TEST_F(CliOutput, Path_ThatIsAFolder_IsRefused) {
  std::filesystem::create_directory(path("out.glb"));
  expectFailure(failed, {"bake", "scene.glb", "-o", "out.glb"}, {"-o out.glb", "folder"});
  expectFailure(failed, {"bake", "scene.glb", "-o", "scene.glb/out.glb"}, {"-o scene.glb/out.glb"});
}

TEST_F(CliOutput, Folder_Unwritable_IsRefused) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  std::filesystem::create_directory(path("locked"));
  std::filesystem::permissions(path("locked"),
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  expectFailure(failed, {"bake", "scene.glb", "-o", "locked/out.glb"}, {"-o locked/out.glb"});
}

TEST_F(CliOutput, Input_IsCheckedBeforeTheOutput) {
  expectFailure(3, {"bake", "none.glb", "-o", "nowhere/out.glb"}, {"none.glb"});
}

TEST_F(CliOutput, Platform_Missing_NamesThePackage) {
  const ProcessOptions bare{.environment = {{"OCL_ICD_VENDORS", "/nonexistent-dir"}}};
  expectFailure(noDevice, {"bake", "scene.glb", "-o", "out.glb"}, {"pocl-opencl-icd"}, bare);
  expectFailure(noDevice, {"devices"}, {"pocl-opencl-icd"}, bare);
  prelightDone({"info", "scene.glb"}, bare);
}

TEST_F(CliOutput, Device_Unknown_IsNamed) {
  expectFailure(noDevice, {"--device", "abacus", "bake", "scene.glb", "-o", "out.glb"},
                {"--device abacus: no such device"});
  expectFailure(noDevice, {"devices", "--device", "999"}, {"999"});
}

TEST_F(CliOutput, Devices_Listed_AsTextAndJson) {
  EXPECT_FALSE(prelightDone({"devices"}).output.empty());
  const nlohmann::json list = nlohmann::json::parse(prelightDone({"devices", "--json"}).output);
  ASSERT_FALSE(list["devices"].empty());
  EXPECT_EQ(list["devices"][0]["index"], 0);
}

TEST_F(CliOutput, Devices_Tested_GiveAVerdictForEachCheck) {
  const nlohmann::json list =
      nlohmann::json::parse(prelightDone({"devices", "--test", "--json", "--device", "0"}).output);
  ASSERT_EQ(list["devices"].size(), 1u);
  EXPECT_TRUE(list["devices"][0]["passed"].get<bool>());
  ASSERT_FALSE(list["devices"][0]["checks"].empty());
  for (const auto& check : list["devices"][0]["checks"]) EXPECT_TRUE(check["passed"].get<bool>()) << check;
}

TEST_F(CliOutput, Info_DescribesContentsAndPlan) {
  const nlohmann::json info = nlohmann::json::parse(prelightDone({"info", "scene.glb", "--json"}).output);
  EXPECT_EQ(info["contents"]["meshes"], 1);
  EXPECT_EQ(info["contents"]["meshNodes"], 2);
  EXPECT_EQ(info["contents"]["triangles"], 4);
  EXPECT_EQ(info["contents"]["vertices"], 8);
  EXPECT_EQ(info["contents"]["lights"][0]["type"], "point");
  EXPECT_EQ(info["contents"]["cameras"].size(), 1u);
  EXPECT_TRUE(info["baked"].is_null());
  EXPECT_FALSE(info["plan"].empty());
}

TEST_F(CliOutput, SceneList_OfNamesOfAnyLength_AlignsTheDescriptions) {
  const nlohmann::json list = nlohmann::json::parse(prelightDone({"scene", "--list", "--json"}).output);
  const std::string text = prelightDone({"scene", "--list"}).output;
  std::set<std::size_t> columns;
  for (const auto& scene : list["scenes"]) {
    const std::string name = scene["name"], description = scene["description"];
    const std::size_t line = text.find(name + " "), column = text.find(description);
    ASSERT_NE(line, std::string::npos) << name;
    ASSERT_NE(column, std::string::npos) << name;
    columns.insert(column - text.rfind('\n', column) - 1);
  }
  EXPECT_EQ(columns.size(), 1u) << text;
}

TEST_F(CliOutput, BuiltinScenes_AllListedAndWritable) {
  const nlohmann::json list = nlohmann::json::parse(prelightDone({"scene", "--list", "--json"}).output);
  ASSERT_GE(list["scenes"].size(), 4u);
  for (const auto& scene : list["scenes"]) {
    const std::string name = scene["name"];
    prelightDone({"scene", name, "-o", name + ".glb"});
    const nlohmann::json info = nlohmann::json::parse(prelightDone({"info", name + ".glb", "--json"}).output);
    EXPECT_GT(info["contents"]["triangles"], 0) << name;
    EXPECT_GE(info["contents"]["cameras"].size(), 1u) << name;
  }
}

}  // namespace
}  // namespace prelight::test

// Tests --brdf for every command that reads a scene.
#include <gmock/gmock.h>

#include <cstdint>
#include <limits>

#include "cli/cli_test.h"

namespace prelight::test {
namespace {

/// A file in MERL's format with one value everywhere.
std::string merlFile(double value) {
  const std::int32_t sizes[] = {90, 90, 180};
  const std::vector<double> values(std::size_t{3} * 90 * 90 * 180, value);
  return std::string(reinterpret_cast<const char*>(sizes), sizeof(sizes)) +
         std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
}

class CliMeasured : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    prelightDone({"scene", "cornell", "-o", "cornell.glb"});
    writeFile("paint.binary", merlFile(100.0));
  }
};

TEST_F(CliMeasured, Material_ThatTheSceneLacks_IsNamed) {
  expectFailure(badUsage, {"info", "cornell.glb", "--brdf", "nobody=paint.binary"},
                {"--brdf nobody", "the file has 0"});
  expectFailure(badUsage, {"info", "cornell.glb", "--brdf", "paint.binary"}, {"--brdf", "MATERIAL=FILE"});
  expectFailure(badUsage, {"info", "cornell.glb", "--brdf", "=paint.binary"}, {"--brdf", "MATERIAL=FILE"});
}

TEST_F(CliMeasured, File_ThatIsNone_IsRefusedByName) {
  writeFile("short.binary", "abc");
  writeFile("nan.binary", merlFile(std::numeric_limits<double>::quiet_NaN()));
  expectFailure(badInput, {"info", "cornell.glb", "--brdf", "0=none.binary"}, {"none.binary"});
  expectFailure(badInput, {"info", "cornell.glb", "--brdf", "0=short.binary"}, {"short.binary", "3 bytes"});
  expectFailure(badInput, {"info", "cornell.glb", "--brdf", "0=nan.binary"}, {"nan.binary", "red", "nan"});
}

TEST_F(CliMeasured, Picture_OfAnotherMaterial_IsAnother) {
  const std::vector<std::string> options = {"reference", "cornell.glb", "--size", "16x16",
                                            "--spp",     "16",          "-o"};
  const auto rendered = [&](const char* file, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = options;
    arguments.push_back(file);
    arguments.insert(arguments.end(), more.begin(), more.end());
    prelightDone(arguments);
    return readFile(file);
  };
  const std::string plain = rendered("a.exr", {}), other = rendered("b.exr", {"--brdf", "0=paint.binary"});
  EXPECT_NE(plain, other);
}

TEST_F(CliMeasured, BakeAndRender_TakeIt) {
  prelightDone({"bake", "cornell.glb", "-o", "baked.glb", "--glossy", "2", "--rays", "16", "--bounces", "1",
                "--brdf", "0=paint.binary"});
  prelightDone({"render", "baked.glb", "-o", "a.png", "--shading", "glossy", "--size", "16x16", "--brdf",
                "0=paint.binary"});
}

}  // namespace
}  // namespace prelight::test

#include "scene/gltf/uri.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "support/gltf_files.h"

namespace prelight {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* rule = "lies outside of the scene's folder";

/// A folder "scene" with a file in it and a file in a subfolder, beside a file that the scene may not read.
class FileReference : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(home() / "textures");
    for (const fs::path& file : {home() / "inside.bin", home() / "textures" / "below.bin", secret()})
      test::writeBytes(file, "0123456789abcdef");
  }

  fs::path home() const { return folder_ / "scene"; }
  fs::path secret() const { return folder_ / "secret.bin"; }

  /// Error message for a triangle with an unused buffer at this URI, or empty if it is accepted.
  std::string complaintOfBuffer(const std::string& uri, const ReadOptions& options = {}) const {
    GltfDocument document = test::triangleDocument();
    document.json["buffers"].push_back({{"byteLength", 16}, {"uri", uri}});
    return complaint(document, options);
  }
  std::string complaintOfImage(const std::string& uri) const {
    GltfDocument document = test::triangleDocument();
    document.json["images"] = Json::array({{{"uri", uri}}});
    return complaint(document, {});
  }
  std::string complaintOfLightMap(const std::string& uri) const {
    GltfDocument document = test::triangleDocument();
    document.json["nodes"][0]["extensions"]["PRELIGHT_transfer"]["primitives"] =
        Json::array({{{"lightmap", {{"image", uri}}}}});
    return complaint(document, {});
  }

  test::TemporaryFolder folder_;

 private:
  std::string complaint(const GltfDocument& document, const ReadOptions& options) const {
    writeGlb(home() / "scene.glb", document);
    Warnings warnings;
    return test::inputErrorOf([&] { readGltf(home() / "scene.glb", warnings, options); });
  }
};

TEST_F(FileReference, FilesInTheFolderAndBelow_AreTaken) {
  for (const char* uri : {"inside.bin", "./inside.bin", "textures/below.bin", "textures/../inside.bin",
                          "%69nside.bin", "../scene/inside.bin"})
    EXPECT_EQ(complaintOfBuffer(uri), "") << uri;
}

TEST_F(FileReference, FilesElsewhere_AreRefusedUsedOrNot) {
  fs::create_symlink(secret(), home() / "link.bin");
  fs::create_directory_symlink(folder_.path(), home() / "linked");
  for (const std::string& uri :
       {std::string("../secret.bin"), secret().string(), std::string("%2e%2e/secret.bin"),
        std::string("..%2Fsecret.bin"), std::string("textures/../../secret.bin"), std::string("link.bin"),
        std::string("linked/secret.bin"), std::string("../none.bin"), std::string("/etc/passwd")}) {
    EXPECT_NE(complaintOfBuffer(uri).find(rule), std::string::npos) << uri;
    EXPECT_NE(complaintOfImage(uri).find(rule), std::string::npos) << uri;
    EXPECT_NE(complaintOfLightMap(uri).find(rule), std::string::npos) << uri;
  }
  EXPECT_NE(complaintOfBuffer("../secret.bin").find("scene.glb: /buffers/1/uri"), std::string::npos);
}

TEST_F(FileReference, FilesElsewhere_AreTakenWhereAllowed) {
  EXPECT_EQ(complaintOfBuffer("../secret.bin", {.allowOutside = true}), "");
}

TEST_F(FileReference, NeighbourOfTheSameBeginning_IsElsewhere) {
  fs::create_directories(folder_ / "scenery");
  test::writeBytes(folder_ / "scenery/file.bin", "0123456789abcdef");
  EXPECT_NE(complaintOfBuffer("../scenery/file.bin").find(rule), std::string::npos);
}

TEST_F(FileReference, NamesThatNoFileHas_AreRefused) {
  for (const std::string& uri : {std::string(5000, 'x'), std::string(256, 'x'), std::string("a%00b")}) {
    EXPECT_NE(complaintOfBuffer(uri).find("name"), std::string::npos) << uri.size();
    EXPECT_NE(complaintOfLightMap(uri).find("name"), std::string::npos) << uri.size();
  }
}

TEST_F(FileReference, PipesAndDevices_AreRefusedWithoutOpeningThem) {
  ASSERT_EQ(mkfifo((home() / "pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", home() / "zero");
  EXPECT_NE(complaintOfBuffer("pipe").find("a device, a pipe"), std::string::npos);
  EXPECT_NE(complaintOfLightMap("pipe").find("a device, a pipe"), std::string::npos);
  EXPECT_NE(complaintOfLightMap("/dev/zero").find(rule), std::string::npos);
  EXPECT_NE(complaintOfLightMap("zero").find(rule), std::string::npos);
  EXPECT_NE(complaintOfBuffer("/dev/zero", {.allowOutside = true}).find("a device, a pipe"),
            std::string::npos);
}

}  // namespace
}  // namespace prelight

#include <gtest/gtest.h>

#include <cstring>

#include "prelight/error.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using test::TemporaryFolder;

/// A 2 x 1 PNG: red, then half-transparent green.
const std::string pngBase64 =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAAD0lEQVR4nGP4z8DwHwgbABB5A359Y87XAAAAAElFTkSuQmCC";

std::string triangleGltf(const std::string& extra) {
  return R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "buffers": [{"byteLength": 36, "uri": "my%20positions.bin"},
                {"byteLength": 3, "uri": "data:application/octet-stream;base64,AAEC"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 1, "byteLength": 3}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR"}])" +
         extra + "}";
}

void writePositions(const std::filesystem::path& path) {
  const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::string bytes(sizeof(positions), '\0');
  std::memcpy(bytes.data(), positions, sizeof(positions));
  test::writeBytes(path, bytes);
}

TEST(ReadGltf, ExternalAndDataUriBuffers_MergeIntoOne) {
  const TemporaryFolder folder;
  writePositions(folder / "my positions.bin");
  test::writeBytes(folder / "scene.gltf", triangleGltf(""));
  Warnings warnings;
  const GltfDocument document = readGltf(folder / "scene.gltf", warnings);
  ASSERT_EQ(document.json["buffers"].size(), 1u);
  EXPECT_EQ(document.json["buffers"][0]["byteLength"], document.bin.size());
  EXPECT_FALSE(document.json["buffers"][0].contains("uri"));
  EXPECT_EQ(document.json["bufferViews"][1]["buffer"], 0);
  EXPECT_EQ(document.json["bufferViews"][1]["byteOffset"], 36);
  const Scene scene = loadScene(document, warnings);
  EXPECT_EQ(scene.meshes[0].primitives[0].triangles, (std::vector<glm::uvec3>{{0, 1, 2}}));
  EXPECT_TRUE(warnings.empty());
}

TEST(ReadGltf, BufferFileTooShort_Throws) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "my positions.bin", "short");
  test::writeBytes(folder / "scene.gltf", triangleGltf(""));
  Warnings warnings;
  const std::string message = test::inputErrorOf([&] { readGltf(folder / "scene.gltf", warnings); });
  EXPECT_NE(message.find("/buffers/0/byteLength: expected 36 bytes, got 5"), std::string::npos) << message;
}

TEST(ReadGltf, ImagesByUri_AreEmbeddedOnceAndDecoded) {
  const TemporaryFolder folder;
  writePositions(folder / "my positions.bin");
  const std::string uri = "data:image/png;base64," + pngBase64;
  test::writeBytes(folder / "scene.gltf",
                   triangleGltf(R"(, "images": [{"uri": ")" + uri + R"("}, {"uri": ")" + uri + R"("}],
    "textures": [{"source": 1}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])"));
  Warnings warnings;
  const GltfDocument document = readGltf(folder / "scene.gltf", warnings);
  EXPECT_EQ(document.json["images"][0]["bufferView"], document.json["images"][1]["bufferView"]);
  EXPECT_EQ(document.json["images"][0]["mimeType"], "image/png");
  EXPECT_FALSE(document.json["images"][0].contains("uri"));
  const Scene scene = loadScene(document, warnings);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  ASSERT_EQ(scene.images[1].width, 2);
  // Alpha is not multiplied into the colour.
  EXPECT_EQ(scene.images[1].rgba, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 128}));
}

TEST(ReadGltf, MissingOrBrokenImage_WarnsAndBecomesWhite) {
  const TemporaryFolder folder;
  writePositions(folder / "my positions.bin");
  test::writeBytes(folder / "junk.png", "this is no picture");
  test::writeBytes(folder / "scene.gltf",
                   triangleGltf(R"(, "images": [{"uri": "missing.png"}, {"uri": "junk.png"}],
    "textures": [{"source": 0}, {"source": 1}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "emissiveTexture": {"index": 1}}])"));
  Warnings warnings;
  const GltfDocument document = readGltf(folder / "scene.gltf", warnings);
  EXPECT_EQ(document.json["images"][0]["uri"], "missing.png");
  const Scene scene = loadScene(document, warnings);
  EXPECT_EQ(warnings.size(), 2u);
  for (const Image& image : scene.images)
    EXPECT_EQ(image.rgba, (std::vector<std::uint8_t>{255, 255, 255, 255}));
  writeGlb(folder / "out.glb", document);
  Warnings again;
  EXPECT_NO_THROW(loadScene(readGltf(folder / "out.glb", again), again));
}

TEST(WriteGlb, ReadBack_GivesTheSameDocument) {
  const TemporaryFolder folder;
  const GltfDocument document = test::triangleDocument();
  writeGlb(folder / "scene.glb", document);
  Warnings warnings;
  const GltfDocument copy = readGltf(folder / "scene.glb", warnings);
  EXPECT_EQ(copy.json, document.json);
  EXPECT_EQ(copy.bin, document.bin);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1)
      << "a temporary was left";
}

TEST(WriteGlb, MissingFolder_ThrowsRuntimeFailure) {
  const TemporaryFolder folder;
  try {
    writeGlb(folder / "none/scene.glb", test::triangleDocument());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::RuntimeFailure);
    EXPECT_NE(std::string(error.what()).find("cannot write"), std::string::npos);
  }
}

}  // namespace
}  // namespace prelight

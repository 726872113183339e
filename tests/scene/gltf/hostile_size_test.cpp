// Files of a few bytes that claim gigabytes are refused before the memory is allocated.
#include <gtest/gtest.h>

#include <string>

#include "images/picture_header.h"
#include "scene/gltf/image_decode.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Json = nlohmann::ordered_json;

void appendBig32(Bytes& bytes, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(number >> shift));
}

/// The beginning of a PNG with one bit per texel, followed by `more` bytes.
Bytes pngHeader(std::uint32_t width, std::uint32_t height, std::size_t more) {
  Bytes bytes = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n', 0, 0, 0, 13, 'I', 'H', 'D', 'R'};
  appendBig32(bytes, width);
  appendBig32(bytes, height);
  bytes.insert(bytes.end(), {1, 0, 0, 0, 0});
  bytes.resize(bytes.size() + more);
  return bytes;
}

/// The beginning of a JPEG: a segment to skip, and the header of a progressive frame.
Bytes jpegHeader(std::uint16_t width, std::uint16_t height) {
  Bytes bytes = {0xFF, 0xD8, 0xFF, 0xE0, 0, 4, 1, 2, 0xFF, 0xC2, 0, 17, 8};
  for (const std::uint16_t side : {height, width}) {
    bytes.push_back(static_cast<std::uint8_t>(side >> 8));
    bytes.push_back(static_cast<std::uint8_t>(side & 0xFF));
  }
  bytes.resize(bytes.size() + 40);
  return bytes;
}

/// The header of a lossless WebP.
Bytes webpHeader(std::uint32_t width, std::uint32_t height) {
  const std::string start =
      std::string("RIFF") + std::string(4, '\0') + "WEBPVP8L" + std::string(4, '\0') + "/";
  Bytes bytes(start.begin(), start.end());
  const std::uint32_t bits = (width - 1) | (height - 1) << 14;
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(bits >> shift));
  bytes.resize(bytes.size() + 20);
  return bytes;
}

/// The header of a DDS file of 16384 x 16384 texels, as OpenImageIO would accept it.
Bytes ddsHeader() {
  Bytes bytes(128, 0);
  const std::string magic = "DDS |";
  std::copy(magic.begin(), magic.end(), bytes.begin());
  bytes[8] = 0x07;
  bytes[9] = 0x10;
  bytes[13] = bytes[17] = 0x40;
  return bytes;
}

/// A triangle with materials that show these pictures.
GltfDocument texturedTriangle(const std::vector<Bytes>& pictures) {
  GltfDocument document = test::triangleDocument();
  document.json["materials"] = Json::array();
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    test::appendBytes(document, pictures[i], "SCALAR", pictures[i].size(), 5121);
    document.json["images"].push_back({{"bufferView", document.json["bufferViews"].size() - 1}});
    document.json["textures"].push_back({{"source", i}});
    document.json["materials"].push_back({{"emissiveTexture", {{"index", i}}}});
  }
  return document;
}

std::string complaint(const GltfDocument& document, Warnings& warnings) {
  return test::inputErrorOf([&] { loadScene(document, warnings); });
}

TEST(PictureExtent, Headers_TellTheSize) {
  for (const Bytes& bytes : {pngHeader(300, 200, 0), jpegHeader(300, 200), webpHeader(300, 200)}) {
    const auto extent = pictureExtent(bytes);
    ASSERT_TRUE(extent);
    EXPECT_EQ(extent->width, 300u);
    EXPECT_EQ(extent->height, 200u);
    for (std::size_t length = 0; length < bytes.size(); ++length)
      (void)pictureExtent(std::span(bytes).first(length));  // It must not read beyond the bytes.
  }
  EXPECT_FALSE(pictureExtent(pngHeader(0, 200, 0)));
  EXPECT_FALSE(pictureExtent(ddsHeader()));
  EXPECT_FALSE(pictureExtent({}));
}

TEST(PictureExtent, LeastBytes_AreWhatTheFormatCanCompressTo) {
  EXPECT_EQ(pictureExtent(pngHeader(8 * 1032, 1000, 0))->leastBytes, 1000u);
  EXPECT_GT(pictureExtent(pngHeader(0x7FFFFFFF, 0x7FFFFFFF, 0))->leastBytes, std::uint64_t{1} << 48);
  EXPECT_GT(pictureExtent(jpegHeader(65535, 65535))->leastBytes, std::uint64_t{1} << 21);
}

TEST(LoadScene, PictureOfAFormatThatGltfHasNot_IsRefused) {
  Warnings warnings;
  const std::string message = complaint(texturedTriangle({ddsHeader(), ddsHeader()}), warnings);
  EXPECT_NE(message.find("/images/0: the picture is DDS, expected PNG, JPEG, WebP, AVIF or KTX2"),
            std::string::npos)
      << message;
}

TEST(LoadScene, PictureTooLarge_IsRefused) {
  Warnings warnings;
  const Bytes large = pngHeader(20000, 20000, 60000);
  EXPECT_NE(complaint(texturedTriangle({large}), warnings).find("20000 x 20000 texels"), std::string::npos);
}

TEST(LoadScene, PicturesTooLargeTogether_AreRefused) {
  Warnings warnings;
  const Bytes half = webpHeader(8000, 8000);
  const std::string message = complaint(texturedTriangle({half, half, half}), warnings);
  EXPECT_NE(message.find("/images/2: the images so far have 192000000 texels"), std::string::npos) << message;
}

/// As for any broken picture, white texels replace these, and no memory is allocated; a decoder would be
/// asked for 1 GB each.
TEST(LoadScene, PicturesOfMoreTexelsThanTheirBytesHold_AreBroken) {
  Warnings warnings;
  const Scene scene =
      loadScene(texturedTriangle({pngHeader(16000, 16000, 100), jpegHeader(16000, 16000)}), warnings);
  for (const Image& image : scene.images) EXPECT_EQ(image.width, 1);
  EXPECT_TRUE(test::anyContains(warnings, "16000 x 16000 texels in 129 bytes"));
  EXPECT_TRUE(test::anyContains(warnings, "16000 x 16000 texels in 57 bytes"));
}

GltfDocument instancedTriangle(std::uint64_t instances) {
  GltfDocument document = test::triangleDocument();
  document.json["accessors"].push_back({{"componentType", 5126}, {"count", instances}, {"type", "VEC3"}});
  document.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 3;
  return document;
}

TEST(LoadScene, InstancesWithoutData_AreBounded) {
  Warnings warnings;
  EXPECT_EQ(loadScene(instancedTriangle(1000), warnings).meshNodes.at(0).transforms.size(), 1000u);
  const std::string message = complaint(instancedTriangle(10'000'000), warnings);
  EXPECT_NE(
      message.find("/nodes/0: with its 10000000 instances the scene draws 10000000 triangles of 30000000 "
                   "vertices"),
      std::string::npos)
      << message;
}

TEST(LoadScene, AccessorsWithoutData_AreBounded) {
  GltfDocument document = test::triangleDocument();
  document.json["accessors"][0] = {{"componentType", 5126}, {"count", 1 << 24}, {"type", "VEC3"}};
  document.json["accessors"][1] = document.json["accessors"][0];
  Warnings warnings;
  EXPECT_NE(complaint(document, warnings).find("16777216 vertices"), std::string::npos);
}

}  // namespace
}  // namespace prelight

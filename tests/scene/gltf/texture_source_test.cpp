#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "images/picture_header.h"
#include "scene/gltf/gltf_use.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

/// A triangle whose base colour uses texture 0. Images 0 and 1 are PNGs with a red and a blue texel.
GltfDocument texturedDocument(const std::string& texture) {
  GltfDocument document = test::triangleDocument();
  document.json["images"] = Json::parse(R"([
    {"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC"},
    {"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGNgYPgPAAEDAQAIicLsAAAAAElFTkSuQmCC"}])");
  document.json["textures"] = {Json::parse(texture)};
  document.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  document.json["extensionsUsed"] = {"EXT_texture_webp", "EXT_texture_avif", "KHR_texture_basisu"};
  document.json["extensionsRequired"] = {"EXT_texture_webp", "KHR_texture_basisu"};
  return document;
}

/// First texel of the base colour.
std::vector<int> texelOf(const GltfDocument& document, Warnings& warnings) {
  const Scene scene = test::reload(document, warnings);
  const Image& image = scene.images[static_cast<std::size_t>(scene.materials[0].baseColorTexture.image)];
  return {image.rgba[0], image.rgba[1], image.rgba[2]};
}

const std::vector<int> red = {255, 0, 0}, blue = {0, 0, 255};

TEST(TextureSource, WebPOrAvif_CountsBeforeTheSource) {
  for (const char* extension : {"EXT_texture_webp", "EXT_texture_avif"}) {
    Warnings warnings;
    const std::string texture =
        std::string(R"({"source": 0, "extensions": {")") + extension + R"(": {"source": 1}}})";
    EXPECT_EQ(texelOf(texturedDocument(texture), warnings), blue) << extension;
    EXPECT_THAT(warnings, testing::IsEmpty());
  }
}

TEST(TextureSource, BasisBesideASource_IsNotShown) {
  Warnings warnings;
  const std::string texture = R"({"source": 0, "extensions": {"KHR_texture_basisu": {"source": 1}}})";
  EXPECT_EQ(texelOf(texturedDocument(texture), warnings), red);
  EXPECT_THAT(warnings, testing::IsEmpty());
}

TEST(TextureSource, BasisAlone_IsShown) {
  Warnings warnings;
  EXPECT_EQ(texelOf(texturedDocument(R"({"extensions": {"KHR_texture_basisu": {"source": 1}}})"), warnings),
            blue);
  EXPECT_THAT(warnings, testing::IsEmpty());
}

TEST(TextureSource, OutOfRange_IsRefused) {
  const std::string error = test::inputErrorOf([] {
    Warnings warnings;
    (void)texelOf(texturedDocument(R"({"extensions": {"EXT_texture_webp": {"source": 7}}})"), warnings);
  });
  EXPECT_THAT(error, testing::HasSubstr(
                         "/textures/0/extensions/EXT_texture_webp/source: image index 7 out of range"));
}

}  // namespace
}  // namespace prelight

// Light in encodings, written and read again.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "charts/make_light_map_layout.h"
#include "encodings/registry/registry.h"
#include "images/pixels.h"
#include "io/baked_file.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/gltf_files.h"
#include "techniques/light_map/light_map_file.h"

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

/// Made-up numbers of all encodings at `places` places.
std::vector<EncodedLight> madeUp(std::size_t places, float first) {
  std::vector<EncodedLight> lights;
  for (const Encoding& encoding : encodings()) {
    EncodedLight light{std::string(encoding.name), {}};
    for (std::size_t i = 0; i < places * encoding.values; ++i)
      light.values.push_back(first - 0.25f * static_cast<float>(i % 1013));
    lights.push_back(std::move(light));
  }
  return lights;
}

/// A scene whose vertices and light map hold made-up numbers of all encodings.
struct Written {
  test::TemporaryFolder folder;
  std::filesystem::path file = folder / "room.glb";
  CompiledScene compiled;
  Bake bake;

  explicit Written(GltfDocument document) {
    Warnings warnings;
    const Scene scene = loadScene(document, warnings);
    compiled = compileScene(scene, warnings);
    LightMap& map = bake.lightMap.emplace();
    map.layout = makeLightMapLayout(scene, compiled, {.texels = 2048});
    map.values.assign(3 * map.layout.texelCount(), 0.5f);
    map.encoded = madeUp(map.layout.texelCount(), 3.0f);
    bake.irradiance.emplace(compiled.vertexCount(), glm::vec3(1.0f));
    bake.encodedLight = madeUp(compiled.vertexCount(), 7.0f);
    embedBake(document, compiled, bake);
    embedLightMap(document, compiled, map.layout, lightMapPath(file).filename().string());
    writeLightMap(lightMapPath(file), map);
    writeGlb(file, document);
  }

  GltfDocument read() const {
    Warnings warnings;
    return readGltf(file, warnings);
  }
};

Json& entryOf(GltfDocument& document, std::size_t node = 0) {
  return document.json["nodes"][node]["extensions"]["PRELIGHT_transfer"]["primitives"][0]["encodedLight"];
}

GltfDocument whiteTriangle() {
  GltfDocument document = test::triangleDocument();
  document.json["materials"] = Json::array({{{"pbrMetallicRoughness", {{"metallicFactor", 0.0}}}}});
  document.json["meshes"][0]["primitives"][0]["material"] = 0;
  return document;
}

void expectSame(const std::vector<EncodedLight>& got, const std::vector<EncodedLight>& expected) {
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_EQ(got[i].encoding, expected[i].encoding);
    EXPECT_EQ(got[i].values, expected[i].values) << got[i].encoding;
  }
}

TEST(BakedEncodedLight, WriteRead_GivesItBack) {
  for (const char* name : {"cornell", "shapes"}) {
    const Written written(makeBuiltinScene(name));
    const std::optional<Bake> copy = readBake(written.read(), written.compiled);
    ASSERT_TRUE(copy && copy->lightMap) << name;
    expectSame(copy->encodedLight, written.bake.encodedLight);
    expectSame(copy->lightMap->encoded, written.bake.lightMap->encoded);
    EXPECT_EQ(copy->lightMap->values, written.bake.lightMap->values);
  }
}

/// Channels are named after the encoding, one per number, beside the irradiance that all programs show.
TEST(BakedEncodedLight, Picture_HasAChannelANumber) {
  const Written written(whiteTriangle());
  const PictureLayers layers = readPictureLayers(lightMapPath(written.file));
  std::size_t expected = 3;
  for (const EncodedLight& light : written.bake.lightMap->encoded) {
    const std::size_t count = light.values.size() / written.bake.lightMap->layout.texelCount();
    expected += count;
    const PictureChannel* second = layers.find("encoded." + light.encoding + ".001");
    ASSERT_NE(second, nullptr);
    for (std::size_t texel = 0; texel < second->values.size(); ++texel)
      ASSERT_EQ(second->values[texel], light.values[texel * count + 1]);
  }
  EXPECT_EQ(layers.channels.size(), expected);
}

TEST(BakedEncodedLight, EncodingOfAnotherVersion_IsLeftOut) {
  const Written written(whiteTriangle());
  GltfDocument document = written.read();
  entryOf(document)[0]["encoding"] = "of another version";
  const std::optional<Bake> copy = readBake(document, written.compiled);
  ASSERT_TRUE(copy);
  std::vector<EncodedLight> expected = written.bake.encodedLight;
  expected.erase(expected.begin());
  expectSame(copy->encodedLight, expected);
}

TEST(BakedEncodedLight, BakedAnew_LeavesNothingBehind) {
  const Written written(whiteTriangle());
  GltfDocument document = written.read(), plain = whiteTriangle();
  embedBake(document, written.compiled, Bake{});
  embedBake(plain, written.compiled, Bake{});
  EXPECT_EQ(document.json["accessors"].size(), plain.json["accessors"].size());
}

/// Expects that a file changed by `spoil` is refused with a message that contains `word`.
void expectComplaint(const Written& written, const std::function<void(GltfDocument&)>& spoil,
                     const std::string& word) {
  GltfDocument document = written.read();
  spoil(document);
  const std::string message = test::inputErrorOf([&] { readBake(document, written.compiled); });
  EXPECT_NE(message.find(word), std::string::npos) << message;
}

TEST(BakedEncodedLight, WrongMembers_AreRefused) {
  const Written written(whiteTriangle());
  expectComplaint(
      written, [](GltfDocument& d) { entryOf(d) = 3; }, "/encodedLight");
  expectComplaint(
      written, [](GltfDocument& d) { entryOf(d)[0].erase("encoding"); }, "/encodedLight/0");
  expectComplaint(
      written, [](GltfDocument& d) { entryOf(d)[0]["values"] = 999; }, "/encodedLight/0/values");
  expectComplaint(
      written,
      [](GltfDocument& d) {
        entryOf(d)[0]["values"] = test::appendFloats(d, {0.0f, 1.0f}, "SCALAR");
      },
      "got 2");
  expectComplaint(
      written, [](GltfDocument& d) { entryOf(d)[1] = entryOf(d)[0]; }, "for a second time");
}

TEST(BakedEncodedLight, PrimitivesThatDiffer_AreRefused) {
  const Written written(makeBuiltinScene("cornell"));
  GltfDocument document = written.read();
  for (std::size_t node = 0; node < document.json["nodes"].size(); ++node)
    if (document.json["nodes"][node].contains("mesh")) {
      entryOf(document, node).erase(0);
      break;
    }
  const std::string message = test::inputErrorOf([&] { readBake(document, written.compiled); });
  EXPECT_NE(message.find("encodings of the other primitives"), std::string::npos) << message;
}

/// The picture lacks one of an encoding's channels.
TEST(BakedEncodedLight, PictureThatLacksAChannel_IsRefused) {
  Written written(whiteTriangle());
  LightMap& map = *written.bake.lightMap;
  const std::size_t texels = map.layout.texelCount(), count = map.encoded[0].values.size() / texels;
  map.encoded[0].values.resize((count - 1) * texels);
  writeLightMap(lightMapPath(written.file), map);
  expectComplaint(
      written, [](GltfDocument&) {}, "there is no channel encoded." + map.encoded[0].encoding + ".0");
}

}  // namespace
}  // namespace prelight

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "prelight/compiled_scene.h"
#include "prelight/error.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/load/loader.h"
#include "scene/pose.h"
#include "support/bent_bar.h"
#include "support/gltf_files.h"

namespace prelight {
namespace {

/// A small file with many features: sparse accessors, instances, lights, cameras, materials and a hierarchy.
GltfDocument richDocument() {
  GltfDocument document = test::triangleDocument();
  const int offsets = test::appendFloats(document, {0, 0, 0, 2, 0, 0}, "VEC3");
  auto& json = document.json;
  json["accessors"][0]["sparse"] = {{"count", 1},
                                    {"indices", {{"bufferView", 2}, {"componentType", 5121}}},
                                    {"values", {{"bufferView", 1}}}};
  json["nodes"][0]["children"] = {1, 2};
  json["nodes"][0]["rotation"] = {0, 0.7, 0, 0.7};
  json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = offsets;
  json["nodes"].push_back({{"camera", 0}, {"translation", {1, 2, 3}}});
  json["nodes"].push_back({{"scale", {2, -2, 2}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  json["cameras"] = nlohmann::ordered_json::parse(
      R"([{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1, "aspectRatio": 1.5}}])");
  json["extensions"]["KHR_lights_punctual"]["lights"] =
      nlohmann::ordered_json::parse(R"([{"type": "spot", "intensity": 4, "spot": {"outerConeAngle": 0.7}}])");
  json["materials"][0]["extensions"]["KHR_materials_volume"]["thicknessFactor"] = 1;
  json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.5, 0.5, 1};
  const int times = test::appendFloats(document, {0, 1, 2}, "SCALAR");
  const int places = test::appendFloats(document, {0, 0, 0, 1, 0, 0, 2, 0, 0}, "VEC3");
  json["animations"] = {
      {{"samplers", {{{"input", times}, {"output", places}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}}}}}};
  return document;
}

/// Loads the bytes completely and returns whether they are a scene. Errors other than a clean one are thrown.
bool isLoaded(const std::filesystem::path& path, const std::string& bytes) {
  test::writeBytes(path, bytes);
  Warnings warnings;
  try {
    Scene scene = loadScene(readGltf(path, warnings), warnings);
    for (std::size_t i = 0; i < scene.animations.size(); ++i) setPose(scene, i, 0.75);
    compileScene(scene, warnings);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

TEST(ReadGltf, FlippedBytes_ThrowInputErrorOrLoad) {
  const test::TemporaryFolder folder;
  writeGlb(folder / "good.glb", richDocument());
  const std::string good = test::readBytes(folder / "good.glb");
  ASSERT_TRUE(isLoaded(folder / "good.glb", good));
  std::mt19937 random(7);
  int loaded = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string bytes = good;
    const int flips = 1 + static_cast<int>(random() % 4);
    for (int f = 0; f < flips; ++f) bytes[random() % bytes.size()] = static_cast<char>(random());
    ASSERT_NO_THROW(loaded += isLoaded(folder / "bad.glb", bytes)) << "iteration " << i;
  }
  // Some files load and some do not: the changes reach past the first check, and some do harm.
  EXPECT_GT(loaded, 50);
  EXPECT_LT(loaded, 2850);
}

/// A file with everything that deforms: a skin, two morph targets, animated weights and an animated material.
GltfDocument deformedDocument() {
  GltfDocument document = test::bentBar();
  auto& json = document.json;
  auto& primitive = json["meshes"][0]["primitives"][0];
  const std::vector<float> lifts(3 * test::barPositions().size(), 0.25f);
  for (int i = 0; i < 2; ++i)
    primitive["targets"].push_back({{"POSITION", test::appendFloats(document, lifts, "VEC3")},
                                    {"NORMAL", test::appendFloats(document, lifts, "VEC3")}});
  json["nodes"][2]["weights"] = {0.5, 0.25};
  auto& animation = json["animations"][0];
  const auto times = animation["samplers"][0]["input"];
  const int weights = test::appendFloats(document, {0, 0, 1, 2}, "SCALAR");
  const int colors = test::appendFloats(document, {0, 0, 0, 1, 1, 1, 1, 1}, "VEC4");
  animation["samplers"].push_back({{"input", times}, {"output", weights}});
  animation["samplers"].push_back({{"input", times}, {"output", colors}});
  animation["channels"].push_back({{"sampler", 1}, {"target", {{"node", 2}, {"path", "weights"}}}});
  animation["channels"].push_back(
      {{"sampler", 2},
       {"target",
        {{"path", "pointer"},
         {"extensions",
          {{"KHR_animation_pointer",
            {{"pointer", "/materials/0/pbrMetallicRoughness/baseColorFactor"}}}}}}}});
  return document;
}

/// Changed digits do most harm: counts, offsets, indices.
void expectDigitsToBeSafe(const GltfDocument& document) {
  const test::TemporaryFolder folder;
  writeGlb(folder / "good.glb", document);
  const std::string good = test::readBytes(folder / "good.glb");
  std::vector<std::size_t> digits;
  for (std::size_t i = 20; i < good.find("BIN"); ++i) {
    if (good[i] >= '0' && good[i] <= '9') digits.push_back(i);
  }
  ASSERT_TRUE(isLoaded(folder / "good.glb", good));
  std::mt19937 random(11);
  int loaded = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = good;
    bytes[digits[random() % digits.size()]] = static_cast<char>('0' + random() % 10);
    ASSERT_NO_THROW(loaded += isLoaded(folder / "bad.glb", bytes)) << "iteration " << i;
  }
  // Some files load and some do not: the changes reach past the first check, and some do harm.
  EXPECT_GT(loaded, 100);
  EXPECT_LT(loaded, 1900);
}

TEST(ReadGltf, ChangedDigits_ThrowInputErrorOrLoad) { expectDigitsToBeSafe(richDocument()); }

TEST(ReadGltf, ChangedDigitsOfSkinsAndMorphTargets_ThrowInputErrorOrLoad) {
  expectDigitsToBeSafe(deformedDocument());
}

TEST(ReadGltf, FlippedBytesOfSkinsAndMorphTargets_ThrowInputErrorOrLoad) {
  const test::TemporaryFolder folder;
  writeGlb(folder / "good.glb", deformedDocument());
  const std::string good = test::readBytes(folder / "good.glb");
  ASSERT_TRUE(isLoaded(folder / "good.glb", good));
  std::mt19937 random(5);
  const std::size_t begin = good.find("BIN");
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = good;
    for (int f = 0; f < 3; ++f)
      bytes[begin + 4 + random() % (good.size() - begin - 4)] = static_cast<char>(random());
    ASSERT_NO_THROW(isLoaded(folder / "bad.glb", bytes)) << "iteration " << i;
  }
}

TEST(ReadGltf, EveryTruncation_Throws) {
  const test::TemporaryFolder folder;
  writeGlb(folder / "good.glb", test::triangleDocument());
  const std::string good = test::readBytes(folder / "good.glb");
  Warnings warnings;
  for (std::size_t length = 0; length < good.size(); ++length) {
    test::writeBytes(folder / "bad.glb", good.substr(0, length));
    EXPECT_THROW(readGltf(folder / "bad.glb", warnings), InputError) << length;
  }
}

}  // namespace
}  // namespace prelight

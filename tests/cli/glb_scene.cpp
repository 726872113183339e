#include "cli/glb_scene.h"

#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace prelight::test {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint32_t glbMagic = 0x46546C67;
constexpr std::uint32_t jsonChunk = 0x4E4F534A;
constexpr std::uint32_t binChunk = 0x004E4942;

void appendWord(std::string& bytes, std::size_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>((word >> shift) & 0xff));
}

std::uint32_t readWord(const std::string& bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.substr(offset, 4).data(), 4);
  return word;
}

template <typename T>
void appendArray(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

}  // namespace

std::string GlbScene::bytes() const {
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string padded = bin;
  padded.resize((padded.size() + 3) / 4 * 4, '\0');
  std::string bytes;
  appendWord(bytes, glbMagic);
  appendWord(bytes, 2);
  appendWord(bytes, 12 + 8 + text.size() + (padded.empty() ? 0 : 8 + padded.size()));
  appendWord(bytes, text.size());
  appendWord(bytes, jsonChunk);
  bytes += text;
  if (!padded.empty()) {
    appendWord(bytes, padded.size());
    appendWord(bytes, binChunk);
    bytes += padded;
  }
  return bytes;
}

GlbScene floorAndRoof() {
  GlbScene scene;
  appendArray<float>(scene.bin, {-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1});
  appendArray<float>(scene.bin, {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0});
  appendArray<std::uint16_t>(scene.bin, {0, 1, 2, 0, 2, 3});
  scene.json = Json::parse(R"({
    "asset": {"version": "2.0"},
    "extensionsUsed": ["KHR_lights_punctual"],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "name": "lamp", "intensity": 20}]}},
    "scene": 0,
    "scenes": [{"nodes": [0, 1, 2, 3]}],
    "nodes": [
      {"name": "floor", "mesh": 0, "scale": [2, 1, 2]},
      {"name": "roof", "mesh": 0, "translation": [0, 1, 0]},
      {"name": "eye", "camera": 0, "translation": [0, 1.5, 5], "rotation": [-0.1, 0, 0, 0.99498744]},
      {"name": "lamp", "translation": [0, 3, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}}
    ],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.01, "aspectRatio": 1.5}}],
    "materials": [{"name": "matt", "doubleSided": true,
                   "pbrMetallicRoughness": {"baseColorFactor": [0.7, 0.5, 0.3, 1], "metallicFactor": 0}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": 0}]}],
    "buffers": [{"byteLength": 108}],
    "bufferViews": [
      {"buffer": 0, "byteOffset": 0, "byteLength": 48},
      {"buffer": 0, "byteOffset": 48, "byteLength": 48},
      {"buffer": 0, "byteOffset": 96, "byteLength": 12}
    ],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, 0, -1], "max": [1, 0, 1]},
      {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
      {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}
    ]
  })");
  return scene;
}

GlbScene floorAndRoofWithChart(bool first) {
  GlbScene scene = floorAndRoof();
  scene.bin += std::string(4 - scene.bin.size() % 4, '\0');
  const std::size_t at = scene.bin.size();
  for (const float value : {0.0f, 0.0f, 1.0f, 0.0f, 1.0f, 1.0f, 0.0f, 1.0f})
    scene.bin.append(reinterpret_cast<const char*>(&value), sizeof value);
  auto& json = scene.json;
  json["buffers"][0]["byteLength"] = scene.bin.size();
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", 32}});
  json["accessors"].push_back({{"bufferView", 3}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
  json["meshes"].push_back(json["meshes"][0]);
  json["nodes"][1]["mesh"] = 1;
  json["meshes"][first ? 0 : 1]["primitives"][0]["attributes"]["TEXCOORD_0"] = 3;
  return scene;
}

GlbScene emptyScene() {
  GlbScene scene;
  scene.json = Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{}]})");
  return scene;
}

GlbScene parseGlb(const std::string& bytes) {
  if (bytes.size() < 20 || readWord(bytes, 0) != glbMagic || readWord(bytes, 8) != bytes.size())
    throw std::runtime_error("not a whole .glb");
  GlbScene scene;
  const std::size_t jsonBytes = readWord(bytes, 12);
  scene.json = Json::parse(bytes.substr(20, jsonBytes));
  if (bytes.size() > 20 + jsonBytes)
    scene.bin = bytes.substr(28 + jsonBytes, readWord(bytes, 20 + jsonBytes));
  return scene;
}

std::vector<float> floatAccessor(const GlbScene& scene, std::size_t index) {
  const Json& accessor = scene.json.at("accessors").at(index);
  const Json& view = scene.json.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
  const std::size_t offset =
      view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
  const std::size_t components = accessor.at("type") == "VEC3" ? 3 : 1;
  std::vector<float> values(accessor.at("count").get<std::size_t>() * components);
  std::memcpy(values.data(), scene.bin.substr(offset, values.size() * sizeof(float)).data(),
              values.size() * sizeof(float));
  return values;
}

}  // namespace prelight::test

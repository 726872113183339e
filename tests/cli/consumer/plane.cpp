#include "plane.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

namespace {

constexpr std::array<float, 12> positions = {-10, 0, 10, 10, 0, 10, 10, 0, -10, -10, 0, -10};
constexpr std::array<float, 12> normals = {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
constexpr std::array<std::uint16_t, 6> indices = {0, 1, 2, 0, 2, 3};

std::string binaryData() {
  std::string bytes(sizeof positions + sizeof normals + sizeof indices, '\0');
  std::memcpy(bytes.data(), positions.data(), sizeof positions);
  std::memcpy(bytes.data() + sizeof positions, normals.data(), sizeof normals);
  std::memcpy(bytes.data() + sizeof positions + sizeof normals, indices.data(), sizeof indices);
  return bytes;
}

constexpr const char* json = R"({
  "asset": {"version": "2.0"},
  "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_specular"],
  "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 10}]}},
  "scene": 0,
  "scenes": [{"nodes": [0, 1]}],
  "nodes": [
    {"mesh": 0},
    {"translation": [0, 1, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}}
  ],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": 0}]}],
  "materials": [{
    "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0},
    "extensions": {"KHR_materials_specular": {"specularFactor": 0}}
  }],
  "buffers": [{"byteLength": 108}],
  "bufferViews": [
    {"buffer": 0, "byteLength": 48},
    {"buffer": 0, "byteOffset": 48, "byteLength": 48},
    {"buffer": 0, "byteOffset": 96, "byteLength": 12}
  ],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-10, 0, -10], "max": [10, 0, 10]},
    {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
    {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}
  ]
})";

std::string numberBytes(std::uint32_t value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

std::string chunk(const char* type, std::string data, char padding) {
  data.resize((data.size() + 3) / 4 * 4, padding);
  return numberBytes(static_cast<std::uint32_t>(data.size())) + std::string(type, 4) + data;
}

}  // namespace

prelight::LoadedScene plane() {
  const std::string chunks = chunk("JSON", json, ' ') + chunk("BIN\0", binaryData(), '\0');
  const std::string file =
      "glTF" + numberBytes(2) + numberBytes(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
  return prelight::load(std::as_bytes(std::span(file)));
}

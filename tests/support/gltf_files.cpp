#include "support/gltf_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>

#include "prelight/error.h"
#include "scene/gltf/load/loader.h"

namespace prelight::test {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "prelight-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void writeBytes(const fs::path& path, std::string_view bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw std::runtime_error("cannot write " + path.string());
}

std::string readBytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

int appendFloats(GltfDocument& document, const std::vector<float>& values, const std::string& type) {
  const std::size_t components = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
  return appendAccessor(document, std::as_bytes(std::span(values)), type, 5126, values.size() / components);
}

int appendBytes(GltfDocument& document, const std::vector<std::uint8_t>& values, const std::string& type,
                std::size_t count, int componentType) {
  return appendAccessor(document, std::as_bytes(std::span(values)), type, componentType, count);
}

GltfDocument triangleDocument() {
  GltfDocument document;
  document.path = "triangle.glb";
  document.json = nlohmann::ordered_json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"name": "node", "mesh": 0}],
    "meshes": [{"name": "mesh", "primitives": [
      {"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": 0}]}],
    "materials": [{"name": "material"}]})");
  appendFloats(document, {0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  appendFloats(document, {0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  appendBytes(document, {0, 0, 1, 0, 2, 0}, "SCALAR", 3, 5123);
  return document;
}

Scene reload(const GltfDocument& document, Warnings& warnings) {
  const TemporaryFolder folder;
  writeGlb(folder / "scene.glb", document);
  return loadScene(readGltf(folder / "scene.glb", warnings), warnings);
}

CompiledScene compileDocument(const GltfDocument& document) {
  Warnings warnings;
  return compileScene(loadScene(document, warnings), warnings);
}

CompiledScene recompile(const GltfDocument& document, Warnings& warnings) {
  return compileScene(reload(document, warnings), warnings);
}

std::string inputErrorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

bool anyContains(const Warnings& warnings, std::string_view text) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const std::string& w) { return w.find(text) != std::string::npos; });
}

void replaceFloats(GltfDocument& document, float marker, float value) {
  int replaced = 0;
  for (std::size_t at = 0; at + sizeof(float) <= document.bin.size(); at += sizeof(float)) {
    if (std::memcmp(&document.bin[at], &marker, sizeof marker) != 0) continue;
    std::memcpy(&document.bin[at], &value, sizeof value);
    ++replaced;
  }
  EXPECT_GT(replaced, 0) << "no float is " << marker;
}

}  // namespace prelight::test

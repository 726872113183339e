#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight::test {

/// A new folder in the system's temporary folder, removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

void writeBytes(const std::filesystem::path& path, std::string_view bytes);
std::string readBytes(const std::filesystem::path& path);

/// One triangle (0,0,0) (1,0,0) (0,1,0) with +Z normals, 16-bit indices, a material and a node. The accessors
/// are 0: positions, 1: normals, 2: indices.
GltfDocument triangleDocument();

int appendFloats(GltfDocument& document, const std::vector<float>& values, const std::string& type);
int appendBytes(GltfDocument& document, const std::vector<std::uint8_t>& values, const std::string& type,
                std::size_t count, int componentType);

/// The document's scene, compiled.
CompiledScene compileDocument(const GltfDocument& document);

/// Writes the document as .glb, reads it again and loads it.
Scene reload(const GltfDocument& document, Warnings& warnings);
CompiledScene recompile(const GltfDocument& document, Warnings& warnings);

/// Message of the InputError that `action` throws, or empty if it throws none.
std::string inputErrorOf(const std::function<void()>& action);

/// Whether a warning contains `text`.
bool anyContains(const Warnings& warnings, std::string_view text);

/// Replaces every float `marker` in a document's buffer by `value`. In this way values that the writer
/// refuses reach the reader.
void replaceFloats(GltfDocument& document, float marker, float value);

}  // namespace prelight::test

#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "scene/gltf_document.h"
#include "scene/json_cursor.h"
#include "scene/scene.h"

namespace prelight {

/// What the parts of loadScene share. Core glTF comes from tinygltf's model. Numbers of extensions come from
/// the JSON tree, since tinygltf narrows integers there to 32 bits; the binary data comes from the document
/// itself.
struct LoadContext {
  LoadContext(const GltfDocument& source, Warnings& out);
  LoadContext(const LoadContext&) = delete;
  LoadContext& operator=(const LoadContext&) = delete;

  /// "FILE: " followed by the JSON path.
  std::string where(const std::string& jsonPath) const { return file + ": " + jsonPath; }
  void warn(const std::string& jsonPath, const std::string& what) const {
    warnings.push_back(where(jsonPath) + ": " + what);
  }
  /// The extension `name` of a JSON object, when it has it.
  static std::optional<JsonCursor> extension(const JsonCursor& object, std::string_view name);

  const GltfDocument& document;
  Warnings& warnings;
  std::string file;
  JsonCursor root;
  tinygltf::Model model;
};

/// A node of the scene with its transform to world space.
struct WorldNode {
  int node = 0;
  glm::dmat4 world{1.0};
};

/// Nodes of the chosen scene in depth-first order.
std::vector<WorldNode> collectWorldNodes(const LoadContext& context);

/// World transforms of a node's instances; its own when it is not instanced.
std::vector<glm::dmat4> instanceTransforms(const LoadContext& context, const WorldNode& node);

Mesh loadMesh(const LoadContext& context, std::size_t mesh);
std::vector<Material> loadMaterials(const LoadContext& context);
/// Decodes the images that materials use; the others are white texels.
std::vector<Image> loadImages(const LoadContext& context, const std::vector<Material>& materials);
/// The punctual light of a node, when it carries one.
std::optional<Light> loadLight(const LoadContext& context, const WorldNode& node);
Camera loadCamera(const LoadContext& context, const WorldNode& node);

/// A JSON number as a finite float. Throws InputError with the number's path when it overflows.
float finiteFloat(const JsonCursor& number);

}  // namespace prelight

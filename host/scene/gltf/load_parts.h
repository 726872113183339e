#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "prelight/error.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

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

/// Nodes of the chosen scene in depth-first order.
std::vector<SceneNode> loadNodes(const LoadContext& context);

/// Transforms to world space of nodes of loadNodes. Throws InputError when one is not finite.
std::vector<glm::dmat4> restTransforms(const LoadContext& context, const std::vector<SceneNode>& nodes);

/// Transforms of a glTF node's instances to the node; empty when it is not instanced.
std::vector<glm::dmat4> loadInstances(const LoadContext& context, int node);

/// Checks and reads all animations; `nodes` are those of loadNodes. Channels of morph weights, of nodes that
/// are not in the scene and of unknown paths are left out, the first and the last with a warning.
std::vector<Animation> loadAnimations(const LoadContext& context, const std::vector<SceneNode>& nodes);

Mesh loadMesh(const LoadContext& context, std::size_t mesh);
/// One warning that counts the primitives of points and lines of the meshes that are marked: they are left
/// empty.
void warnOfPointsAndLines(const LoadContext& context, const std::vector<bool>& meshes);
std::vector<Material> loadMaterials(const LoadContext& context);
/// Decodes the images that materials use; the others are white texels, as are those that cannot be read, with
/// a warning. Materials lose normal textures that cannot be read.
std::vector<Image> loadImages(const LoadContext& context, std::vector<Material>& materials);
/// The punctual light of a node, when it carries one.
std::optional<Light> loadLight(const LoadContext& context, int node, const glm::dmat4& world);
Camera loadCamera(const LoadContext& context, int node, const glm::dmat4& world);

/// A JSON number as a finite float. Throws InputError with the number's path when it overflows.
float finiteFloat(const JsonCursor& number);

}  // namespace prelight

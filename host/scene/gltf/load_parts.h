#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
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

/// Checks and reads all animations of a scene that is complete but for them. Channels of what is not in the
/// scene are left out, as are, with a warning, those of what cannot be animated.
std::vector<Animation> loadAnimations(const LoadContext& context, Scene& scene);

/// A mesh with its materials, as a variant has them; -1: the primitives' own.
Mesh loadMesh(const LoadContext& context, std::size_t mesh, int variant = -1);

/// Adds a primitive's morph targets, of which an attribute that the primitive lacks is left out.
void loadMorphTargets(const LoadContext& context, const JsonCursor& json, Primitive& primitive);

/// Adds the joints that a primitive's vertices hang on, their weights made to sum up to 1.
void loadInfluences(const LoadContext& context, const JsonCursor& json, const std::string& path,
                    Primitive& primitive);

/// The most morph targets that a primitive of a mesh has.
std::size_t countTargets(const Mesh& mesh);

/// The `weights` of a node or a mesh, one for each target; the mesh's where a node has none.
std::vector<float> loadWeights(const JsonCursor& holder, const Mesh& mesh);

/// Reads skins once nodes ask for them.
class SkinLoader {
 public:
  static constexpr int none = -1;

  /// The arguments outlive it; `nodes` are those of loadNodes.
  SkinLoader(const LoadContext& context, const std::vector<SceneNode>& nodes);

  /// The skin of a glTF node, into `skins`, to which it is added; `none` where it has none or, with a
  /// warning, where it cannot be applied to the mesh. Throws InputError for joints that it lacks.
  int skinOf(const JsonCursor& node, std::size_t mesh, const Mesh& loaded, std::vector<Skin>& skins);

 private:
  const LoadContext& context_;
  const std::vector<SceneNode>& nodes_;
  std::map<std::size_t, std::size_t> places_;  ///< of the file's nodes in nodes_, once a skin is asked for
  std::map<std::size_t, int> known_;
};

/// What an animation's channel moves.
struct AnimationTarget {
  std::string text;      ///< for messages
  std::size_t node = 0;  ///< of the file, of a path
  std::optional<AnimatedPath> path = {};
  std::optional<AnimatedProperty> property = {};
  std::vector<std::size_t> objects = {};  ///< of the scene, that have the property
  bool isFactor = false;                  ///< a number that multiplies the property
  glm::vec4 other{1.0f};                  ///< what the property is multiplied by, or multiplies, at rest
};

/// A node's property by the name that channels give it.
std::optional<AnimatedPath> animatedPath(std::string_view name);

/// Follows the pointers of KHR_animation_pointer.
class PointerFinder {
 public:
  /// The arguments outlive it.
  PointerFinder(const LoadContext& context, const Scene& scene);

  /// What a pointer leads to; nullopt for what is not animated. Throws InputError for one that leads nowhere.
  std::optional<AnimationTarget> find(const JsonCursor& pointer) const;

 private:
  using Objects =
      std::map<std::size_t, std::vector<std::size_t>>;  ///< of the scene, by their index in the file

  AnimationTarget lightTarget(AnimationTarget target, std::size_t light) const;

  const LoadContext& context_;
  const Scene& scene_;
  Objects lights_, cameras_;
};

/// Names of the file's sets of materials (KHR_materials_variants).
std::vector<std::string> loadVariants(const LoadContext& context);

/// The material that a primitive has in a variant; its own where the variant says nothing of it.
int materialOfVariant(const LoadContext& context, const JsonCursor& primitive, int variant, int own);

/// One warning that counts the primitives of points and lines of the meshes that are marked: they are left
/// empty.
void warnOfPointsAndLines(const LoadContext& context, const std::vector<bool>& meshes);
std::vector<Material> loadMaterials(const LoadContext& context);
/// Decodes the images that materials use; the others are white texels, as are those that cannot be read, with
/// a warning. Materials lose normal textures that cannot be read.
std::vector<Image> loadImages(const LoadContext& context, std::vector<Material>& materials);
/// The punctual light of a node, when it carries one.
std::optional<Light> loadLight(const LoadContext& context, int node, const glm::dmat4& world);
/// Reads each profile of lamps once (EXT_lights_ies), however many entries name its bytes.
class ProfileLoader {
 public:
  /// The context outlives it.
  explicit ProfileLoader(const LoadContext& context) : context_(context) {}

  /// The lamp of a node, when it carries one.
  std::optional<Light> lightOf(int node, const glm::dmat4& world);

 private:
  std::shared_ptr<const LightProfile> profileOf(std::size_t index);
  /// Counts what a further profile takes. Throws InputError where that is too much.
  void take(const JsonCursor& json, std::size_t& taken, std::size_t more, std::size_t most,
            const char* unit) const;

  const LoadContext& context_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::shared_ptr<const LightProfile>>
      known_;                                ///< by offset and length
  std::size_t bytes_ = 0, intensities_ = 0;  ///< of all that are known
};

Camera loadCamera(const LoadContext& context, int node, const glm::dmat4& world);

/// A JSON number as a finite float. Throws InputError with the number's path when it overflows.
float finiteFloat(const JsonCursor& number);

}  // namespace prelight

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

/// Data shared by the parts of loadScene. Core glTF comes from tinygltf's model. Numbers of extensions come
/// from the JSON tree, because tinygltf narrows integers there to 32 bits; the binary data comes from the
/// document itself.
struct LoadContext {
  LoadContext(const GltfDocument& source, Warnings& out);
  LoadContext(const LoadContext&) = delete;
  LoadContext& operator=(const LoadContext&) = delete;

  /// Returns "FILE: " followed by the JSON path.
  std::string where(const std::string& jsonPath) const { return file + ": " + jsonPath; }
  void warn(const std::string& jsonPath, const std::string& what) const {
    warnings.push_back(where(jsonPath) + ": " + what);
  }
  /// Returns the extension `name` of a JSON object, if it has it.
  static std::optional<JsonCursor> extension(const JsonCursor& object, std::string_view name);

  const GltfDocument& document;
  Warnings& warnings;
  std::string file;
  JsonCursor root;
  tinygltf::Model model;
};

/// Returns the nodes of the chosen scene in depth-first order.
std::vector<SceneNode> loadNodes(const LoadContext& context);

/// Returns the transforms to world space of nodes of loadNodes. Throws InputError when one is not finite.
std::vector<glm::dmat4> restTransforms(const LoadContext& context, const std::vector<SceneNode>& nodes);

/// Returns the transforms of a glTF node's instances to the node; empty when it is not instanced.
std::vector<glm::dmat4> loadInstances(const LoadContext& context, int node);

/// Checks and reads all animations of a scene whose other parts are complete. Channels of objects that are
/// not in the scene are left out, as are, with a warning, channels of properties that cannot be animated.
std::vector<Animation> loadAnimations(const LoadContext& context, Scene& scene);

/// Returns a mesh with the materials of a variant; -1: the primitives' own materials.
Mesh loadMesh(const LoadContext& context, std::size_t mesh, int variant = -1);

/// Adds a primitive's morph targets, without attributes that the primitive lacks.
void loadMorphTargets(const LoadContext& context, const JsonCursor& json, Primitive& primitive);

/// Adds the joints and weights of a primitive's vertices; the weights are normalised to a sum of 1.
void loadInfluences(const LoadContext& context, const JsonCursor& json, const std::string& path,
                    Primitive& primitive);

/// Returns the greatest number of morph targets of a mesh's primitives.
std::size_t countTargets(const Mesh& mesh);

/// Returns the `weights` of a node or a mesh, one per target; the mesh's where a node has none.
std::vector<float> loadWeights(const JsonCursor& holder, const Mesh& mesh);

/// Reads skins when nodes first use them.
class SkinLoader {
 public:
  static constexpr int none = -1;

  /// The arguments must outlive this object; `nodes` are those of loadNodes.
  SkinLoader(const LoadContext& context, const std::vector<SceneNode>& nodes);

  /// Returns the index in `skins` of a glTF node's skin, which is added there; `none` where the node has no
  /// skin or, with a warning, where it cannot be applied to the mesh. Throws InputError for joints that the
  /// skin lacks.
  int skinOf(const JsonCursor& node, std::size_t mesh, const Mesh& loaded, std::vector<Skin>& skins);

 private:
  const LoadContext& context_;
  const std::vector<SceneNode>& nodes_;
  std::map<std::size_t, std::size_t> places_;  ///< index in nodes_ by node of the file, once a skin is needed
  std::map<std::size_t, int> known_;
};

/// The target of an animation's channel.
struct AnimationTarget {
  std::string text;      ///< for messages
  std::size_t node = 0;  ///< node of the file, for a path
  std::optional<AnimatedPath> path = {};
  std::optional<AnimatedProperty> property = {};
  std::vector<std::size_t> objects = {};  ///< objects of the scene that have the property
  bool isFactor = false;                  ///< the target is a number that multiplies the property
  glm::vec4 other{1.0f};                  ///< value at rest of the factor, or of what a factor multiplies
};

/// Returns a node's property by its name in channels.
std::optional<AnimatedPath> animatedPath(std::string_view name);

/// Resolves the pointers of KHR_animation_pointer.
class PointerFinder {
 public:
  /// The arguments must outlive this object.
  PointerFinder(const LoadContext& context, const Scene& scene);

  /// Returns the target of a pointer; nullopt if it is not animated. Throws InputError for a pointer that
  /// leads nowhere.
  std::optional<AnimationTarget> find(const JsonCursor& pointer) const;

 private:
  using Objects =
      std::map<std::size_t, std::vector<std::size_t>>;  ///< objects of the scene by their index in the file

  AnimationTarget lightTarget(AnimationTarget target, std::size_t light) const;

  const LoadContext& context_;
  const Scene& scene_;
  Objects lights_, cameras_;
};

/// Returns the names of the file's variants (KHR_materials_variants).
std::vector<std::string> loadVariants(const LoadContext& context);

/// Returns the material of a primitive in a variant; its own where the variant does not list it.
int materialOfVariant(const LoadContext& context, const JsonCursor& primitive, int variant, int own);

/// Adds one warning that counts the primitives of points and lines of the marked meshes, which stay empty.
void warnOfPointsAndLines(const LoadContext& context, const std::vector<bool>& meshes);
std::vector<Material> loadMaterials(const LoadContext& context);
/// Decodes the images that materials use; the others become white texels, as do those that cannot be read,
/// with a warning. Materials lose normal textures that cannot be read.
std::vector<Image> loadImages(const LoadContext& context, std::vector<Material>& materials);
/// Returns the punctual light of a node, if it has one.
std::optional<Light> loadLight(const LoadContext& context, int node, const glm::dmat4& world);
/// Reads each lamp profile once (EXT_lights_ies), however many entries refer to its bytes.
class ProfileLoader {
 public:
  /// The context must outlive this object.
  explicit ProfileLoader(const LoadContext& context) : context_(context) {}

  /// Returns the lamp of a node, if it has one.
  std::optional<Light> lightOf(int node, const glm::dmat4& world);

 private:
  std::shared_ptr<const LightProfile> profileOf(std::size_t index);
  /// Adds the size of a further profile. Throws InputError where the sum is too large.
  void take(const JsonCursor& json, std::size_t& taken, std::size_t more, std::size_t most,
            const char* unit) const;

  const LoadContext& context_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::shared_ptr<const LightProfile>>
      known_;                                ///< by offset and length
  std::size_t bytes_ = 0, intensities_ = 0;  ///< sums over all known profiles
};

Camera loadCamera(const LoadContext& context, int node, const glm::dmat4& world);

/// Returns a JSON number as a finite float. Throws InputError with the number's path when it overflows.
float finiteFloat(const JsonCursor& number);

/// Counts what the nodes draw before any of it is read. Throws InputError when that is out of proportion to
/// the file (more than 2^22 vertices or triangles plus 256 per byte of its data, where a node counts as 64
/// bytes): shared meshes, instances and accessors without data let a few bytes stand for any amount of
/// memory. Throws Error (OutOfMemory) when the arrays alone take more memory than the machine has.
void checkSceneSize(const LoadContext& context, const std::vector<SceneNode>& nodes);

}  // namespace prelight

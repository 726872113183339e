#include "scene/gltf/gltf_use.h"

#include <array>
#include <string_view>

#include "scene/gltf/draco_primitives.h"
#include "scene/gltf/json_cursor.h"
#include "scene/gltf/meshopt_views.h"
#include "scene/gltf/texture_source.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;
using Indices = std::set<std::size_t>;

/// A member of an object; null of anything else, and where there is none.
const Json& memberOf(const Json& object, std::string_view key) {
  static const Json none;
  if (!object.is_object()) return none;
  const auto found = object.find(std::string(key));
  return found == object.end() ? none : *found;
}

/// An element of an array, or null.
const Json& elementOf(const Json& array, std::size_t index) {
  static const Json none;
  return array.is_array() && index < array.size() ? array[index] : none;
}

void addIndex(const Json& json, Indices& indices) {
  if (const auto index = unsignedValue(json)) indices.insert(*index);
}

template <class Visit>
void forEachElement(const Json& array, Visit visit) {
  if (!array.is_array()) return;
  for (const Json& element : array) visit(element);
}

void addInfluences(const Json& attributes, GltfUse& use) {
  if (!attributes.is_object()) return;
  for (const auto& [name, accessor] : attributes.items())
    if (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_")) addIndex(accessor, use.accessors);
}

void addSkins(const Json& root, GltfUse& use) {
  for (const std::size_t index : use.skins)
    addIndex(memberOf(elementOf(memberOf(root, "skins"), index), "inverseBindMatrices"), use.accessors);
}

void addDraco(const Json& primitive, GltfUse& use) {
  const Json& draco = memberOf(memberOf(primitive, "extensions"), dracoExtension);
  addIndex(memberOf(draco, "bufferView"), use.bufferViews);
  if (!draco.is_object()) return;
  addIndex(memberOf(primitive, "indices"), use.dracoAccessors);
  const Json& attributes = memberOf(draco, "attributes");
  if (!attributes.is_object()) return;
  for (const auto& attribute : attributes.items())
    addIndex(memberOf(memberOf(primitive, "attributes"), attribute.key()), use.dracoAccessors);
}

/// The attributes that meshes and their morph targets are loaded with; others but joints are not read.
void addMeshes(const Json& root, GltfUse& use) {
  constexpr std::array<std::string_view, 6> read = {"POSITION",   "NORMAL",     "TANGENT",
                                                    "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"};
  forEachElement(memberOf(root, "meshes"), [&](const Json& mesh) {
    forEachElement(memberOf(mesh, "primitives"), [&](const Json& primitive) {
      const Json& attributes = memberOf(primitive, "attributes");
      for (const std::string_view name : read) addIndex(memberOf(attributes, name), use.accessors);
      addInfluences(attributes, use);
      forEachElement(memberOf(primitive, "targets"), [&](const Json& target) {
        for (const std::string_view name : read) addIndex(memberOf(target, name), use.accessors);
      });
      addIndex(memberOf(primitive, "indices"), use.accessors);
      addDraco(primitive, use);
    });
  });
}

void addAnimations(const Json& root, GltfUse& use) {
  forEachElement(memberOf(root, "animations"), [&](const Json& animation) {
    forEachElement(memberOf(animation, "samplers"), [&](const Json& sampler) {
      addIndex(memberOf(sampler, "input"), use.accessors);
      addIndex(memberOf(sampler, "output"), use.accessors);
    });
  });
}

/// Any number in baked data may be an accessor.
void addNumbers(const Json& json, Indices& indices) {
  addIndex(json, indices);
  if (!json.is_structured()) return;
  for (const Json& part : json) addNumbers(part, indices);
}

void addNodes(const Json& root, GltfUse& use) {
  forEachElement(memberOf(root, "nodes"), [&](const Json& node) {
    addIndex(memberOf(node, "camera"), use.cameras);
    addIndex(memberOf(node, "skin"), use.skins);
    const Json& extensions = memberOf(node, "extensions");
    addIndex(memberOf(memberOf(extensions, "KHR_lights_punctual"), "light"), use.lights);
    addIndex(memberOf(memberOf(extensions, "EXT_lights_ies"), "light"), use.profiles);
    const Json& instances = memberOf(memberOf(extensions, "EXT_mesh_gpu_instancing"), "attributes");
    for (const std::string_view name : {"TRANSLATION", "ROTATION", "SCALE"})
      addIndex(memberOf(instances, name), use.accessors);
    addNumbers(memberOf(extensions, "PRELIGHT_transfer"), use.accessors);
  });
  addNumbers(memberOf(memberOf(root, "extensions"), "PRELIGHT_transfer"), use.accessors);
}

void addViews(const Json& root, GltfUse& use) {
  for (const std::size_t index : use.accessors) {
    const Json& accessor = elementOf(memberOf(root, "accessors"), index);
    const Json& sparse = memberOf(accessor, "sparse");
    addIndex(memberOf(accessor, "bufferView"), use.bufferViews);
    addIndex(memberOf(memberOf(sparse, "indices"), "bufferView"), use.bufferViews);
    addIndex(memberOf(memberOf(sparse, "values"), "bufferView"), use.bufferViews);
  }
  for (const std::size_t index : use.images)
    addIndex(memberOf(elementOf(memberOf(root, "images"), index), "bufferView"), use.bufferViews);
  const Json& profiles = memberOf(memberOf(memberOf(root, "extensions"), "EXT_lights_ies"), "lights");
  for (const std::size_t index : use.profiles)
    addIndex(memberOf(elementOf(profiles, index), "bufferView"), use.bufferViews);
  for (const std::size_t index : use.bufferViews) {
    const Json& view = elementOf(memberOf(root, "bufferViews"), index);
    const std::string compression = meshoptExtensionOf(view);
    addIndex(memberOf(compression.empty() ? view : view.at("extensions").at(compression), "buffer"),
             use.buffers);
  }
}

/// Pictures of skies, of the sharpest level.
void addSkies(const Json& root, GltfUse& use) {
  const Json& extension = memberOf(memberOf(root, "extensions"), "EXT_lights_image_based");
  forEachElement(memberOf(extension, "lights"), [&](const Json& light) {
    forEachElement(elementOf(memberOf(light, "specularImages"), 0),
                   [&](const Json& image) { addIndex(image, use.images); });
  });
}

}  // namespace

GltfUse findUse(const Json& root) {
  GltfUse use;
  addMeshes(root, use);
  addAnimations(root, use);
  addNodes(root, use);
  addSkins(root, use);
  forEachElement(memberOf(root, "textures"), [&](const Json& texture) {
    addIndex(memberOf(texture, "source"), use.images);
    for (const char* name : textureExtensions)
      addIndex(memberOf(memberOf(memberOf(texture, "extensions"), name), "source"), use.images);
  });
  addSkies(root, use);
  addViews(root, use);
  return use;
}

}  // namespace prelight

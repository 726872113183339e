#include "scene/gltf/gltf_use.h"

#include <array>
#include <string_view>

#include "scene/gltf/draco_primitives.h"
#include "scene/gltf/json_cursor.h"
#include "scene/gltf/meshopt_views.h"

namespace prelight {

namespace {

std::optional<JsonCursor> sourceOf(const JsonCursor& texture, const char* extension) {
  const auto extensions = texture.find("extensions");
  const auto found = extensions ? extensions->find(extension) : std::nullopt;
  return found ? found->find("source") : std::nullopt;
}

}  // namespace

void validateTextureSource(const JsonCursor& root, const JsonCursor& texture) {
  const auto check = [&](const std::optional<JsonCursor>& source) {
    if (source) source->asIndex(root.countOf("images"), "image");
  };
  check(texture.find("source"));
  for (const char* extension : textureExtensions) check(sourceOf(texture, extension));
}

std::optional<std::size_t> textureImage(const JsonCursor& texture) {
  for (const auto& source : {sourceOf(texture, "EXT_texture_webp"), sourceOf(texture, "EXT_texture_avif"),
                             texture.find("source"), sourceOf(texture, "KHR_texture_basisu")}) {
    if (source) return source->asUnsigned();
  }
  return std::nullopt;
}

namespace {

using Json = nlohmann::ordered_json;
using Indices = std::set<std::size_t>;

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
    addIndex(part(partAt(part(root, "skins"), index), "inverseBindMatrices"), use.accessors);
}

void addDraco(const Json& primitive, GltfUse& use) {
  const Json& draco = part(part(primitive, "extensions"), dracoExtension);
  addIndex(part(draco, "bufferView"), use.bufferViews);
  if (!draco.is_object()) return;
  addIndex(part(primitive, "indices"), use.dracoAccessors);
  const Json& attributes = part(draco, "attributes");
  if (!attributes.is_object()) return;
  for (const auto& attribute : attributes.items())
    addIndex(part(part(primitive, "attributes"), attribute.key()), use.dracoAccessors);
}

/// Adds the attributes with which meshes and their morph targets are loaded; of others only joints are read.
void addMeshes(const Json& root, GltfUse& use) {
  constexpr std::array<std::string_view, 6> read = {"POSITION",   "NORMAL",     "TANGENT",
                                                    "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"};
  forEachElement(part(root, "meshes"), [&](const Json& mesh) {
    forEachElement(part(mesh, "primitives"), [&](const Json& primitive) {
      const Json& attributes = part(primitive, "attributes");
      for (const std::string_view name : read) addIndex(part(attributes, name), use.accessors);
      addInfluences(attributes, use);
      forEachElement(part(primitive, "targets"), [&](const Json& target) {
        for (const std::string_view name : read) addIndex(part(target, name), use.accessors);
      });
      addIndex(part(primitive, "indices"), use.accessors);
      addDraco(primitive, use);
    });
  });
}

void addAnimations(const Json& root, GltfUse& use) {
  forEachElement(part(root, "animations"), [&](const Json& animation) {
    forEachElement(part(animation, "samplers"), [&](const Json& sampler) {
      addIndex(part(sampler, "input"), use.accessors);
      addIndex(part(sampler, "output"), use.accessors);
    });
  });
}

/// Adds any number in baked data, because it may be an accessor.
void addNumbers(const Json& json, Indices& indices) {
  addIndex(json, indices);
  if (!json.is_structured()) return;
  for (const Json& element : json) addNumbers(element, indices);
}

void addNodes(const Json& root, GltfUse& use) {
  forEachElement(part(root, "nodes"), [&](const Json& node) {
    addIndex(part(node, "camera"), use.cameras);
    addIndex(part(node, "skin"), use.skins);
    const Json& extensions = part(node, "extensions");
    addIndex(part(part(extensions, "KHR_lights_punctual"), "light"), use.lights);
    addIndex(part(part(extensions, "EXT_lights_ies"), "light"), use.profiles);
    const Json& instances = part(part(extensions, "EXT_mesh_gpu_instancing"), "attributes");
    for (const std::string_view name : {"TRANSLATION", "ROTATION", "SCALE"})
      addIndex(part(instances, name), use.accessors);
    addNumbers(part(extensions, "PRELIGHT_transfer"), use.accessors);
  });
  addNumbers(part(part(root, "extensions"), "PRELIGHT_transfer"), use.accessors);
}

void addViews(const Json& root, GltfUse& use) {
  for (const std::size_t index : use.accessors) {
    const Json& accessor = partAt(part(root, "accessors"), index);
    const Json& sparse = part(accessor, "sparse");
    addIndex(part(accessor, "bufferView"), use.bufferViews);
    addIndex(part(part(sparse, "indices"), "bufferView"), use.bufferViews);
    addIndex(part(part(sparse, "values"), "bufferView"), use.bufferViews);
  }
  for (const std::size_t index : use.images)
    addIndex(part(partAt(part(root, "images"), index), "bufferView"), use.bufferViews);
  const Json& profiles = part(part(part(root, "extensions"), "EXT_lights_ies"), "lights");
  for (const std::size_t index : use.profiles)
    addIndex(part(partAt(profiles, index), "bufferView"), use.bufferViews);
  for (const std::size_t index : use.bufferViews) {
    const Json& view = partAt(part(root, "bufferViews"), index);
    const std::string compression = meshoptExtensionOf(view);
    addIndex(part(compression.empty() ? view : view.at("extensions").at(compression), "buffer"), use.buffers);
  }
}

/// Adds images of skies, those of the sharpest level.
void addSkies(const Json& root, GltfUse& use) {
  const Json& extension = part(part(root, "extensions"), "EXT_lights_image_based");
  forEachElement(part(extension, "lights"), [&](const Json& light) {
    forEachElement(partAt(part(light, "specularImages"), 0),
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
  forEachElement(part(root, "textures"), [&](const Json& texture) {
    addIndex(part(texture, "source"), use.images);
    for (const char* name : textureExtensions)
      addIndex(part(part(part(texture, "extensions"), name), "source"), use.images);
  });
  addSkies(root, use);
  addViews(root, use);
  return use;
}

}  // namespace prelight

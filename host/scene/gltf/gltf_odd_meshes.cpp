#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "scene/gltf/gltf_oddities.h"
#include "scene/gltf/json_parts.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

bool isKnownAttribute(std::string_view name) {
  constexpr std::array<std::string_view, 7> known = {"POSITION", "NORMAL",  "TANGENT", "TEXCOORD_",
                                                     "COLOR_",   "JOINTS_", "WEIGHTS_"};
  return name.starts_with("_") ||
         std::any_of(known.begin(), known.end(), [&](std::string_view k) { return name.starts_with(k); });
}

/// Finds oddities in the layout of a vertex accessor in its buffer view.
void findOddLayout(const Json& root, const Json& accessor, const std::string& place, Oddities& odd) {
  constexpr double indices = 34963.0;
  const Json& view = partAt(part(root, "bufferViews"), part(accessor, "bufferView"));
  if (part(view, "target") == indices) odd.add("vertices in a buffer view that is for indices", place);
  const double offset = numberOf(part(accessor, "byteOffset"), 0.0);
  if (std::fmod(offset, 4.0) != 0.0) odd.add("vertices that do not begin at a multiple of 4 bytes", place);
  constexpr double uint32 = 5125.0;
  if (part(accessor, "componentType") == uint32) odd.add("vertices of 32-bit integers", place);
}

void findOddIndices(const Json& root, const Json& accessor, const std::string& place, Oddities& odd) {
  constexpr double vertices = 34962.0;
  const Json& view = partAt(part(root, "bufferViews"), part(accessor, "bufferView"));
  if (part(view, "target") == vertices) odd.add("indices in a buffer view that is for vertices", place);
  if (!part(view, "byteStride").is_null()) odd.add("indices in a buffer view with a byteStride", place);
}

void findOddAttributes(const Json& root, const Json& attributes, const std::string& place, Oddities& odd) {
  if (!attributes.is_object()) return;
  for (const auto& attribute : attributes.items()) {
    const Json& accessor = partAt(part(root, "accessors"), attribute.value());
    findOddLayout(root, accessor, place + "/" + attribute.key(), odd);
    if (attribute.key() == "POSITION" && accessor.is_object() &&
        (part(accessor, "min").is_null() || part(accessor, "max").is_null()))
      odd.add("positions without min and max; they are not needed", place + "/POSITION");
    if (!isKnownAttribute(attribute.key()))
      odd.add("an attribute with an unknown name, which must begin with _; it is not read",
              place + "/" + attribute.key());
  }
}

/// Adds the sets of texture coordinates that a material's textures use, including those in extensions.
void addTextureSets(const Json& json, std::set<std::uint64_t>& sets) {
  if (!json.is_structured()) return;
  for (auto member = json.begin(); member != json.end(); ++member) {
    if (json.is_object() && member.key() == "extras") continue;
    const bool isTexture = json.is_object() && member.key().ends_with("Texture") && member->is_object();
    const Json& transform = isTexture ? part(part(*member, "extensions"), "KHR_texture_transform") : json;
    if (isTexture) {
      const auto own = unsignedValue(part(*member, "texCoord"));
      const auto moved = unsignedValue(part(transform, "texCoord"));
      sets.insert(moved ? *moved : own.value_or(0));
    } else {
      addTextureSets(*member, sets);
    }
  }
}

/// Uses of buffer views: the number of vertex accessors of each, and the views of indices.
class ViewUses {
 public:
  explicit ViewUses(const Json& root) : root_(root) {}

  void addVertices(const Json& accessor, const std::string& place, Oddities& odd) {
    const auto view = viewOf(accessor);
    const auto index = unsignedValue(accessor);
    if (!view) return;
    std::set<std::uint64_t>& accessors = vertices_[*view];
    accessors.insert(*index);
    if (accessors.size() == 2 && part(partAt(part(root_, "bufferViews"), *view), "byteStride").is_null())
      odd.add("vertices of two accessors in a buffer view without a byteStride; each is read as packed",
              place);
    if (indices_.contains(*view)) odd.add(both, place);
  }

  void addIndices(const Json& accessor, const std::string& place, Oddities& odd) {
    const auto view = viewOf(accessor);
    if (!view) return;
    indices_.insert(*view);
    if (vertices_.contains(*view)) odd.add(both, place);
  }

 private:
  static constexpr const char* both = "vertices and indices in one buffer view";

  std::optional<std::size_t> viewOf(const Json& accessor) const {
    const auto view = unsignedValue(part(partAt(part(root_, "accessors"), accessor), "bufferView"));
    return view ? std::optional<std::size_t>(static_cast<std::size_t>(*view)) : std::nullopt;
  }

  const Json& root_;
  std::map<std::size_t, std::set<std::uint64_t>> vertices_;
  std::set<std::size_t> indices_;
};

void findOddViews(const Json& root, Oddities& odd) {
  ViewUses uses(root);
  forEachPart(root, "meshes", [&](const Json& mesh, const std::string& place) {
    const Json& primitives = part(mesh, "primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const std::string within = fmt::format("{}/primitives/{}", place, i);
      const Json& attributes = part(primitives[i], "attributes");
      if (!attributes.is_object()) continue;
      for (const auto& attribute : attributes.items())
        uses.addVertices(attribute.value(), within + "/attributes/" + attribute.key(), odd);
      uses.addIndices(part(primitives[i], "indices"), within + "/indices", odd);
    }
  });
}

/// Returns true when a material rotates normals or lobes by tangents but has no normal texture for which
/// tangents would be computed.
bool needsFileTangents(const Json& material) {
  const Json& extensions = part(material, "extensions");
  const bool turned =
      !part(part(extensions, "KHR_materials_clearcoat"), "clearcoatNormalTexture").is_null() ||
      part(extensions, "KHR_materials_anisotropy").is_object();
  return turned && part(material, "normalTexture").is_null();
}

using TextureSets = std::vector<std::set<std::uint64_t>>;  // [material]

TextureSets textureSets(const Json& root) {
  TextureSets sets;
  for (const Json& material : part(root, "materials")) addTextureSets(material, sets.emplace_back());
  return sets;
}

void findOddPrimitive(const Json& root, const TextureSets& sets, const Json& primitive,
                      const std::string& place, Oddities& odd) {
  const Json& attributes = part(primitive, "attributes");
  findOddAttributes(root, attributes, place + "/attributes", odd);
  findOddIndices(root, partAt(part(root, "accessors"), part(primitive, "indices")), place + "/indices", odd);
  const Json& targets = part(primitive, "targets");
  for (std::size_t i = 0; i < targets.size(); ++i)
    findOddAttributes(root, targets[i], fmt::format("{}/targets/{}", place, i), odd);
  const auto material = unsignedValue(part(primitive, "material"));
  if (!material || *material >= sets.size()) return;
  if (needsFileTangents(partAt(part(root, "materials"), *material)) && part(attributes, "TANGENT").is_null())
    odd.add(
        "a material that needs tangents, and neither TANGENT nor a normal texture; they are made from the "
        "texture coordinates",
        place + "/material");
  for (const std::uint64_t set : sets[*material]) {
    if (part(attributes, fmt::format("TEXCOORD_{}", set)).is_null())
      odd.add("a material with textures, and no coordinates in the primitive for them; they are taken as 0",
              place + "/material");
  }
}

}  // namespace

void findOddMeshes(const Json& root, Oddities& odd) {
  findOddViews(root, odd);
  const TextureSets sets = textureSets(root);
  forEachPart(root, "meshes", [&](const Json& mesh, const std::string& place) {
    const Json& primitives = part(mesh, "primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i)
      findOddPrimitive(root, sets, primitives[i], fmt::format("{}/primitives/{}", place, i), odd);
  });
}

}  // namespace prelight

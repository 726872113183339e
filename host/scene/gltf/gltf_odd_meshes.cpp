#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "scene/gltf/accessor.h"
#include "scene/gltf/gltf_oddities.h"
#include "scene/gltf/json_cursor.h"

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

namespace {

using Json = nlohmann::ordered_json;

/// Squared lengths of unit vectors quantised to 8 bits or fewer lie within this distance of 1.
constexpr float unitTolerance = 0.03f;

bool areUnit(const std::vector<float>& values, std::size_t components) {
  for (std::size_t i = 0; i + components <= values.size(); i += components) {
    const float square =
        values[i] * values[i] + values[i + 1] * values[i + 1] + values[i + 2] * values[i + 2];
    if (!(std::abs(square - 1.0f) <= unitTolerance)) return false;
  }
  return true;
}

void findOddVectors(const AccessorReader& reader, const std::string& name, const std::string& place,
                    Oddities& odd) {
  const std::size_t components = reader.components();
  if (name.starts_with("COLOR_")) {
    for (const float value : reader.floats())
      if (!(value >= 0.0f && value <= 1.0f)) return odd.add("colours outside of 0..1", place);
  } else if ((name == "NORMAL" && components == 3) || (name == "TANGENT" && components == 4)) {
    const std::vector<float> values = reader.floats();
    if (!areUnit(values, components))
      odd.add("vectors that are not of length 1; they are taken as if", place);
    for (std::size_t i = 3; components == 4 && i < values.size(); i += 4)
      if (std::abs(values[i]) != 1.0f) return odd.add("tangents whose w is neither 1 nor -1", place);
  }
}

void findRestarts(const AccessorReader& reader, const Json& accessor, const std::string& place,
                  Oddities& odd) {
  constexpr double uint8 = 5121.0, uint16 = 5123.0;
  const double type = numberOf(part(accessor, "componentType"), 0.0);
  const std::uint32_t restart = type == uint8 ? 0xFFu : type == uint16 ? 0xFFFFu : 0xFFFFFFFFu;
  for (const std::uint32_t index : reader.unsignedIntegers())
    if (index == restart)
      return odd.add("an index that would restart a strip, which glTF has none of", place);
}

}  // namespace

void findOddVertices(const GltfDocument& document, std::uint64_t& left, Oddities& odd) {
  const Json& root = document.json;
  forEachPart(root, "meshes", [&](const Json& mesh, const std::string& meshPlace) {
    const Json& primitives = part(mesh, "primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const std::string place = fmt::format("{}/primitives/{}", meshPlace, p);
      const Json& attributes = part(primitives[p], "attributes");
      for (const auto& attribute : attributes.items()) {
        const auto index = unsignedValue(attribute.value());
        if (!index) continue;
        forReadable(document, *index, left, [&](const AccessorReader& reader) {
          findOddVectors(reader, attribute.key(), place + "/attributes/" + attribute.key(), odd);
        });
      }
      if (const auto index = unsignedValue(part(primitives[p], "indices")))
        forReadable(document, *index, left, [&](const AccessorReader& reader) {
          findRestarts(reader, partAt(part(root, "accessors"), part(primitives[p], "indices")),
                       place + "/indices", odd);
        });
    }
  });
}

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* variantsName = "KHR_materials_variants";

void findOddMapping(const Json& root, std::size_t variants, const Json& mapping, const std::string& place,
                    std::set<std::uint64_t>& seen, Oddities& odd) {
  const auto material = unsignedValue(part(mapping, "material"));
  if (!material || *material >= part(root, "materials").size())
    odd.add("a variant with a material that the file does not have", place + "/material");
  const Json& names = part(mapping, "variants");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto variant = unsignedValue(names[i]);
    const std::string within = fmt::format("{}/variants/{}", place, i);
    if (!variant || *variant >= variants) {
      odd.add("a variant that the file does not list", within);
    } else if (!seen.insert(*variant).second) {
      odd.add("a variant that has a material already; the last one counts", within);
    }
  }
}

}  // namespace

void findOddVariants(const Json& root, Oddities& odd) {
  const Json& extension = part(part(root, "extensions"), variantsName);
  const Json& listed = part(extension, "variants");
  if (extension.is_object() && !listed.is_array())
    odd.add("an extension without its variants", fmt::format("/extensions/{}", variantsName));
  forEachPart(root, "meshes", [&](const Json& mesh, const std::string& meshPlace) {
    const Json& primitives = part(mesh, "primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const Json& mappings = part(part(part(primitives[p], "extensions"), variantsName), "mappings");
      std::set<std::uint64_t> seen;
      for (std::size_t i = 0; i < mappings.size(); ++i)
        findOddMapping(
            root, listed.size(), mappings[i],
            fmt::format("{}/primitives/{}/extensions/{}/mappings/{}", meshPlace, p, variantsName, i), seen,
            odd);
    }
  });
}

}  // namespace prelight

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <vector>

#include "scene/gltf/gltf_oddities.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

/// A member, null where there is none.
const Json& part(const Json& object, const char* key) {
  static const Json none;
  if (!object.is_object()) return none;
  const auto found = object.find(key);
  return found == object.end() ? none : *found;
}

double numberOf(const Json& value, double fallback) {
  return value.is_number() ? value.get<double>() : fallback;
}

template <class Visit>
void forEachPart(const Json& root, const char* list, Visit visit) {
  const Json& parts = part(root, list);
  if (!parts.is_array()) return;
  for (std::size_t i = 0; i < parts.size(); ++i) visit(parts[i], fmt::format("/{}/{}", list, i));
}

void findOddBuffers(const Json& root, Oddities& odd) {
  constexpr double vertices = 34962.0;
  forEachPart(root, "buffers", [&](const Json& buffer, const std::string& place) {
    if (numberOf(part(buffer, "byteLength"), 1.0) == 0.0)
      odd.add("a buffer of 0 bytes, expected 1 at least", place + "/byteLength");
  });
  forEachPart(root, "bufferViews", [&](const Json& view, const std::string& place) {
    if (!view.is_object() || !view.contains("byteStride")) return;
    if (numberOf(view["byteStride"], 0.0) > numberOf(part(view, "byteLength"), 0.0))
      odd.add("a byteStride that is longer than the buffer view", place + "/byteStride");
    if (numberOf(part(view, "target"), vertices) != vertices)
      odd.add("a byteStride in a buffer view that is not for vertices", place + "/byteStride");
  });
  forEachPart(root, "accessors", [&](const Json& accessor, const std::string& place) {
    if (!accessor.is_object()) return;
    if (accessor.contains("byteOffset") && !accessor.contains("bufferView"))
      odd.add("a byteOffset without a bufferView", place + "/byteOffset");
    const double type = numberOf(part(accessor, "componentType"), 0.0);
    if (part(accessor, "normalized") == true && (type == 5126.0 || type == 5125.0))
      odd.add("normalized is for integers of 8 and 16 bits; it is ignored", place + "/normalized");
  });
}

void findOddImages(const Json& root, Oddities& odd) {
  const Json& views = part(root, "bufferViews");
  forEachPart(root, "images", [&](const Json& image, const std::string& place) {
    if (!image.is_object()) return;
    const bool inView = image.contains("bufferView");
    if (inView == image.contains("uri")) odd.add("an image names either a uri or a bufferView", place);
    if (!inView) return;
    if (!image.contains("mimeType"))
      odd.add("an image in a buffer view without a mimeType", place + "/bufferView");
    const auto index = unsignedValue(image["bufferView"]);
    if (index && views.is_array() && *index < views.size() && !part(views[*index], "byteStride").is_null())
      odd.add("an image in a buffer view with a byteStride", place + "/bufferView");
  });
}

void findOddNodes(const Json& root, Oddities& odd) {
  constexpr double tolerance = 0.005;
  forEachPart(root, "nodes", [&](const Json& node, const std::string& place) {
    if (!node.is_object()) return;
    const bool moves = node.contains("translation") || node.contains("rotation") || node.contains("scale");
    if (node.contains("matrix") && moves)
      odd.add("a matrix beside translation, rotation or scale; the matrix counts", place + "/matrix");
    if (node.contains("rotation")) {
      double square = 0.0;
      for (const Json& number : node["rotation"]) square += numberOf(number, 0.0) * numberOf(number, 0.0);
      if (!(std::abs(square - 1.0) < tolerance))
        odd.add("a rotation that is not of length 1; it is taken as if", place + "/rotation");
    }
    for (const char* member : {"skin", "weights"}) {
      if (node.contains(member) && !node.contains("mesh"))
        odd.add(fmt::format("{} without a mesh; ignored", member), place + "/" + member);
    }
  });
  forEachPart(root, "cameras", [&](const Json& camera, const std::string& place) {
    if (!camera.is_object()) return;
    if (camera.contains("perspective") && camera.contains("orthographic"))
      odd.add("a camera that is both perspective and orthographic; its type counts", place);
    for (const char* kind : {"perspective", "orthographic"}) {
      const Json& lens = part(camera, kind);
      if (numberOf(part(lens, "zfar"), INFINITY) <= numberOf(part(lens, "znear"), 0.0))
        odd.add("zfar is not beyond znear; neither is used", place + "/" + kind);
    }
  });
}

bool isKnownAttribute(std::string_view name) {
  constexpr std::array<std::string_view, 7> known = {"POSITION", "NORMAL",  "TANGENT", "TEXCOORD_",
                                                     "COLOR_",   "JOINTS_", "WEIGHTS_"};
  return name.starts_with("_") ||
         std::any_of(known.begin(), known.end(), [&](std::string_view k) { return name.starts_with(k); });
}

void findOddAttributes(const Json& attributes, const std::string& place, Oddities& odd) {
  if (!attributes.is_object()) return;
  for (const auto& attribute : attributes.items()) {
    if (!isKnownAttribute(attribute.key()))
      odd.add("an attribute of no known name, which is to begin with _; it is not read",
              place + "/" + attribute.key());
  }
}

/// The sets of texture coordinates that a material's textures name, with what is in their extensions.
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

using TextureSets = std::vector<std::set<std::uint64_t>>;  // [material]

TextureSets textureSets(const Json& root) {
  TextureSets sets;
  for (const Json& material : part(root, "materials")) addTextureSets(material, sets.emplace_back());
  return sets;
}

void findOddPrimitive(const TextureSets& sets, const Json& primitive, const std::string& place,
                      Oddities& odd) {
  const Json& attributes = part(primitive, "attributes");
  findOddAttributes(attributes, place + "/attributes", odd);
  const Json& targets = part(primitive, "targets");
  for (std::size_t i = 0; i < targets.size(); ++i)
    findOddAttributes(targets[i], fmt::format("{}/targets/{}", place, i), odd);
  const auto material = unsignedValue(part(primitive, "material"));
  if (!material || *material >= sets.size()) return;
  for (const std::uint64_t set : sets[*material]) {
    if (part(attributes, fmt::format("TEXCOORD_{}", set).c_str()).is_null())
      odd.add("a material with textures, and no coordinates in the primitive for them; they are taken as 0",
              place + "/material");
  }
}

void findOddMeshes(const Json& root, Oddities& odd) {
  const TextureSets sets = textureSets(root);
  forEachPart(root, "meshes", [&](const Json& mesh, const std::string& place) {
    const Json& primitives = part(mesh, "primitives");
    std::set<std::size_t> targets;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      findOddPrimitive(sets, primitives[i], fmt::format("{}/primitives/{}", place, i), odd);
      targets.insert(part(primitives[i], "targets").size());
    }
    if (targets.size() > 1)
      odd.add("primitives of one mesh with different numbers of morph targets", place + "/primitives");
    const Json& weights = part(mesh, "weights");
    if (weights.is_array() && !targets.contains(weights.size()))
      odd.add("other than one weight for each morph target", place + "/weights");
  });
}

void findOddLights(const Json& root, Oddities& odd) {
  constexpr double quarterTurn = 0.785398163397448309;
  const char* name = "KHR_lights_punctual";
  const Json& lights = part(part(part(root, "extensions"), name), "lights");
  if (!lights.is_array()) {
    if (!part(part(root, "extensions"), name).is_null())
      odd.add("an extension without its lights", fmt::format("/extensions/{}", name));
    return;
  }
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const Json& spot = part(lights[i], "spot");
    if (!spot.is_object()) continue;
    const double outer = numberOf(part(spot, "outerConeAngle"), quarterTurn);
    if (numberOf(part(spot, "innerConeAngle"), 0.0) >= outer)
      odd.add("an inner cone that is not within the outer one",
              fmt::format("/extensions/{}/lights/{}/spot", name, i));
  }
}

void findDuplicateNames(const Json& root, Oddities& odd) {
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    std::set<std::string> seen;
    forEachPart(root, list, [&](const Json& name, const std::string& place) {
      if (name.is_string() && !seen.insert(name.get<std::string>()).second)
        odd.add("an extension that is listed twice", place);
    });
  }
}

}  // namespace

void findOddParts(const Json& root, Oddities& odd) {
  findOddBuffers(root, odd);
  findOddImages(root, odd);
  findOddNodes(root, odd);
  findOddMeshes(root, odd);
  findOddLights(root, odd);
  findDuplicateNames(root, odd);
}

}  // namespace prelight

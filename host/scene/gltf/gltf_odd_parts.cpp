#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <vector>

#include "images/picture_codecs.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/gltf_oddities.h"
#include "scene/gltf/gltf_use.h"
#include "scene/gltf/json_cursor.h"
#include "scene/gltf/uri.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

bool isListed(const Json& root, const char* list, const Json& name) {
  const Json& names = part(root, list);
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns the MIME type of a data URI; empty for other URIs.
std::string mimeOfUri(const Json& uri) {
  if (!uri.is_string() || !isDataUri(uri.get_ref<const std::string&>())) return {};
  const std::string& text = uri.get_ref<const std::string&>();
  const std::size_t begin = text.find(':') + 1;
  return text.substr(begin, text.find_first_of(";,", begin) - begin);
}

/// Returns true when a file may contain images of this type, given the extensions that it uses.
bool isAllowedPicture(const Json& root, const std::string& mimeType) {
  if (mimeType == "image/png" || mimeType == "image/jpeg") return true;
  return (mimeType == "image/webp" && isListed(root, "extensionsUsed", "EXT_texture_webp")) ||
         (mimeType == "image/avif" && isListed(root, "extensionsUsed", "EXT_texture_avif")) ||
         (mimeType == "image/ktx2" && isListed(root, "extensionsUsed", "KHR_texture_basisu"));
}

void findOddBuffers(const Json& root, Oddities& odd) {
  constexpr double vertices = 34962.0;
  forEachPart(root, "buffers", [&](const Json& buffer, const std::string& place) {
    if (numberOf(part(buffer, "byteLength"), 1.0) == 0.0)
      odd.add("a buffer of 0 bytes, expected 1 at least", place + "/byteLength");
    const Json& uri = part(buffer, "uri");
    if (uri.is_string() && isDataUri(uri.get_ref<const std::string&>()) &&
        uri.get_ref<const std::string&>().find(";;") < uri.get_ref<const std::string&>().find(','))
      odd.add("a data URI with an empty parameter", place + "/uri");
    const std::string mimeType = mimeOfUri(uri);
    if (!mimeType.empty() && mimeType != "application/octet-stream" && mimeType != "application/gltf-buffer")
      odd.add("a MIME type other than application/octet-stream and application/gltf-buffer", place + "/uri");
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
    const std::string stated =
        part(image, "mimeType").is_string() ? image["mimeType"].get<std::string>() : "";
    const std::string inUri = mimeOfUri(part(image, "uri"));
    for (const std::string& mimeType : {stated, inUri}) {
      if (!mimeType.empty() && !isAllowedPicture(root, mimeType))
        odd.add("a picture of a type that the file may not have without an extension", place);
    }
    if (!stated.empty() && !inUri.empty() && stated != inUri)
      odd.add("a mimeType that is not that of the URI", place + "/mimeType");
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

void findOddAnimations(const Json& root, Oddities& odd) {
  forEachPart(root, "animations", [&](const Json& animation, const std::string& place) {
    forEachPart(animation, "samplers", [&](const Json& sampler, const std::string& within) {
      const Json& accessor = partAt(part(root, "accessors"), part(sampler, "input"));
      if (accessor.is_object() && (part(accessor, "min").is_null() || part(accessor, "max").is_null()))
        odd.add("times without min and max; they are not needed", place + within + "/input");
    });
  });
}

void findOddTextures(const Json& root, Oddities& odd) {
  const std::size_t images = part(root, "images").size();
  forEachPart(root, "textures", [&](const Json& texture, const std::string& place) {
    for (const char* extension : textureExtensions) {
      const auto source = unsignedValue(part(part(part(texture, "extensions"), extension), "source"));
      if (source && *source >= images)
        odd.add("an image index out of range", fmt::format("{}/extensions/{}/source", place, extension));
    }
  });
}

void findDuplicateNames(const Json& root, Oddities& odd) {
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    std::set<std::string> seen;
    forEachPart(root, list, [&](const Json& name, const std::string& place) {
      if (name.is_string() && !seen.insert(name.get<std::string>()).second)
        odd.add("an extension that is listed twice", place);
      if (name == "KHR_mesh_quantization" && !isListed(root, "extensionsRequired", name))
        odd.add("an extension that extensionsRequired must list, too", place);
    });
  }
}

}  // namespace

void findOddParts(const Json& root, Oddities& odd) {
  findOddBuffers(root, odd);
  findOddImages(root, odd);
  findOddNodes(root, odd);
  findOddLights(root, odd);
  findOddAnimations(root, odd);
  findOddTextures(root, odd);
  findDuplicateNames(root, odd);
}

namespace {

using Json = nlohmann::ordered_json;

/// Returns the limit of each component as a float, like the values; `none` where the accessor states none, or
/// limits of something else: those of normalised integers are limits of the integers.
std::vector<float> limitsOf(const Json& accessor, const char* name, std::size_t components, float none) {
  std::vector<float> limits(components, none);
  const Json& stated = part(accessor, name);
  if (part(accessor, "normalized") == true || !stated.is_array()) return limits;
  for (std::size_t c = 0; c < std::min(components, stated.size()); ++c)
    limits[c] = static_cast<float>(numberOf(stated[c], none));
  return limits;
}

void findOddNumbers(const Json& accessor, const AccessorReader& reader, const std::string& place,
                    Oddities& odd) {
  const std::size_t components = reader.components();
  const std::vector<float> low = limitsOf(accessor, "min", components, -INFINITY);
  const std::vector<float> high = limitsOf(accessor, "max", components, INFINITY);
  const std::vector<float> values = reader.floats();
  bool finite = true, within = true;
  for (std::size_t i = 0; i < values.size(); i += components) {
    for (std::size_t c = 0; c < components; ++c) {
      finite = finite && std::isfinite(values[i + c]);
      within = within && !(values[i + c] < low[c]) && !(values[i + c] > high[c]);
    }
  }
  if (!finite) odd.add("values that are not finite", place);
  if (!within) odd.add("values outside of min and max, which are not needed", place);
}

}  // namespace

void forReadable(const GltfDocument& document, std::uint64_t accessor, std::uint64_t& left,
                 const std::function<void(const AccessorReader&)>& visit) {
  const Json& json = partAt(part(document.json, "accessors"), static_cast<std::size_t>(accessor));
  const auto index = static_cast<std::size_t>(accessor);
  try {
    if (!json.is_object() || !json.contains("bufferView") || lacksData(document, index)) return;
    const AccessorReader reader(document, index);
    const std::uint64_t numbers = reader.count() * std::uint64_t{reader.components()};
    if (numbers > left) return;
    left -= numbers;
    visit(reader);
  } catch (const InputError&) {
    // Broken data that is not used has been reported.
  }
}

void warnOfOddValues(const GltfDocument& document, Warnings& warnings) {
  // Accessors may share their data, so that a small file could make this loop very long.
  std::uint64_t left = std::uint64_t{1} << 24, leftOfUses = left;
  Oddities odd;
  std::size_t index = 0;
  forEachPart(document.json, "accessors", [&](const Json& accessor, const std::string& place) {
    forReadable(document, index++, left,
                [&](const AccessorReader& reader) { findOddNumbers(accessor, reader, place, odd); });
  });
  findOddVertices(document, leftOfUses, odd);
  findOddMatrices(document, leftOfUses, odd);
  const Json& views = part(document.json, "bufferViews");
  forEachPart(document.json, "images", [&](const Json& image, const std::string& place) {
    const Json& view = partAt(views, part(image, "bufferView"));
    if (!view.is_object() || view.value("buffer", missingBuffer) == missingBuffer) return;
    const auto bytes =
        std::span(document.bin)
            .subspan(view.value("byteOffset", std::size_t{0}), view.value("byteLength", std::size_t{0}));
    const PictureFormat format = pictureFormat(bytes);
    if (format == PictureFormat::Unknown || (isDecoded(format) && !pictureExtent(bytes)))
      odd.add("data that are no picture", place);
  });
  odd.addTo(warnings, document.path.string());
}

namespace {

using Json = nlohmann::ordered_json;

/// Returns the parent of each node; the node itself for roots and where the hierarchy is cyclic.
std::vector<std::size_t> parentsOf(const Json& root) {
  const Json& nodes = part(root, "nodes");
  std::vector<std::size_t> parents(nodes.size());
  for (std::size_t i = 0; i < parents.size(); ++i) parents[i] = i;
  for (std::size_t i = 0; i < parents.size(); ++i)
    for (const Json& child : part(nodes[i], "children"))
      if (const auto index = unsignedValue(child); index && *index < parents.size()) parents[*index] = i;
  return parents;
}

bool liesBelow(const std::vector<std::size_t>& parents, std::size_t node, std::size_t above) {
  for (std::size_t step = 0; step <= parents.size() && node < parents.size(); ++step) {
    if (node == above) return true;
    if (parents[node] == node) return false;
    node = parents[node];
  }
  return false;
}

}  // namespace

void findOddSkins(const Json& root, Oddities& odd) {
  if (part(root, "skins").empty()) return;
  const std::vector<std::size_t> parents = parentsOf(root);
  constexpr std::size_t mostSteps = std::size_t{1} << 24;  // over all joints up to the root
  std::size_t steps = 0;
  forEachPart(root, "skins", [&](const Json& skin, const std::string& place) {
    const Json& matrices = partAt(part(root, "accessors"), part(skin, "inverseBindMatrices"));
    if (!part(partAt(part(root, "bufferViews"), part(matrices, "bufferView")), "byteStride").is_null())
      odd.add("matrices in a buffer view with a byteStride", place + "/inverseBindMatrices");
    const auto skeleton = unsignedValue(part(skin, "skeleton"));
    if (!skeleton) return;
    for (const Json& joint : part(skin, "joints")) {
      const auto node = unsignedValue(joint);
      if (!node || (steps += parents.size()) > mostSteps) return;
      if (liesBelow(parents, static_cast<std::size_t>(*node), static_cast<std::size_t>(*skeleton))) continue;
      return odd.add("a skeleton that is not above all joints; it is not used", place + "/skeleton");
    }
  });
}

void findOddMatrices(const GltfDocument& document, std::uint64_t& left, Oddities& odd) {
  forEachPart(document.json, "skins", [&](const Json& skin, const std::string& place) {
    const auto index = unsignedValue(part(skin, "inverseBindMatrices"));
    if (!index) return;
    forReadable(document, *index, left, [&](const AccessorReader& reader) {
      constexpr std::size_t entries = 16;
      if (reader.components() != entries) return;
      const std::vector<float> values = reader.floats();
      for (std::size_t i = 0; i + entries <= values.size(); i += entries)
        if (values[i + 3] != 0.0f || values[i + 7] != 0.0f || values[i + 11] != 0.0f ||
            values[i + 15] != 1.0f)
          return odd.add("a matrix whose last row is not 0 0 0 1; that row is not used",
                         place + "/inverseBindMatrices");
    });
  });
}

}  // namespace prelight

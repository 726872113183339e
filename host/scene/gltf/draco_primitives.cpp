#include "scene/gltf/draco_primitives.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "scene/codecs/draco_mesh.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/gltf_embed.h"
#include "scene/gltf/gltf_validate.h"
#include "scene/gltf/meshopt_views.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t drawsTriangles = 4;
constexpr std::uint64_t drawsStrip = 5;
constexpr std::uint64_t indexBytes4 = 5125;

std::optional<JsonCursor> dracoOf(const JsonCursor& primitive) {
  const auto extensions = primitive.find("extensions");
  return extensions ? extensions->find(dracoExtension) : std::nullopt;
}

bool isRequired(const Json& root) {
  const auto names = root.find("extensionsRequired");
  return names != root.end() && std::find(names->begin(), names->end(), dracoExtension) != names->end();
}

/// Returns true when all accessors that a primitive's Draco data fills also have uncompressed data.
bool isFallbackThere(const GltfDocument& document, const JsonCursor& primitive, const JsonCursor& draco) {
  bool there = primitive.find("indices").has_value();
  const auto look = [&](const JsonCursor& reference) {
    const std::size_t index = reference.asUnsigned();
    there = there && document.json.at("accessors").at(index).contains("bufferView") &&
            !lacksData(document, index);
  };
  if (there) look(primitive.at("indices"));
  draco.at("attributes").forEachMember([&](const JsonCursor&, const std::string& name) {
    look(primitive.at("attributes").at(name));
  });
  return there;
}

/// The data of an accessor: an attribute of the mesh in a buffer view, or its indices (nullopt), stored with
/// this component type and count.
struct DracoSource {
  std::size_t view = 0;
  std::optional<std::uint32_t> attribute = {};
  std::uint64_t componentType = 0;
  std::size_t components = 0;

  auto operator<=>(const DracoSource&) const = default;
};

/// An array of numbers as a file stores it.
struct StoredArray {
  std::vector<std::uint8_t> bytes;
  std::size_t count = 0;
  std::size_t stride = 0;  ///< from one element to the next
  std::uint64_t componentType = 0;
  std::size_t components = 0;
};

/// Pads elements so that each begins at a multiple of 4 bytes, as vertex attributes must.
StoredArray alignedVertices(StoredArray array) {
  const std::size_t tight = array.stride;
  const std::size_t aligned = (tight + 3) / 4 * 4;
  if (aligned == tight) return array;
  std::vector<std::uint8_t> spread(array.count * aligned);
  for (std::size_t i = 0; i < array.count; ++i)
    std::memcpy(&spread[i * aligned], &array.bytes[i * tight], tight);
  array.bytes = std::move(spread);
  array.stride = aligned;
  return array;
}

template <class Stored>
std::vector<std::uint8_t> packed(const std::vector<std::uint32_t>& numbers) {
  std::vector<std::uint8_t> bytes(numbers.size() * sizeof(Stored));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto stored = static_cast<Stored>(numbers[i]);
    std::memcpy(&bytes[i * sizeof(Stored)], &stored, sizeof(Stored));
  }
  return bytes;
}

/// Returns the indices with the component type that the accessor has, or 32 bits where that is too small.
StoredArray indexArray(const DracoMesh& mesh, std::uint64_t componentType) {
  const std::vector<std::uint32_t> indices = mesh.indices();
  constexpr std::uint64_t uint8 = 5121, uint16 = 5123;
  const std::uint32_t most = indices.empty() ? 0 : *std::max_element(indices.begin(), indices.end());
  StoredArray array{{}, indices.size(), 4, indexBytes4, 1};
  if (componentType == uint8 && most < std::numeric_limits<std::uint8_t>::max()) {
    array.bytes = packed<std::uint8_t>(indices);
    array.stride = 1;
    array.componentType = uint8;
  } else if (componentType == uint16 && most < std::numeric_limits<std::uint16_t>::max()) {
    array.bytes = packed<std::uint16_t>(indices);
    array.stride = 2;
    array.componentType = uint16;
  } else {
    array.bytes = packed<std::uint32_t>(indices);
  }
  return array;
}

/// Sets the least and the greatest value of each component of an accessor of floats.
void setLimits(Json& accessor, const StoredArray& array) {
  constexpr std::uint64_t float32 = 5126;
  if (array.componentType != float32 || array.count == 0) return;
  std::vector<float> low(array.components, std::numeric_limits<float>::infinity());
  std::vector<float> high(array.components, -std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < array.count; ++i) {
    for (std::size_t c = 0; c < array.components; ++c) {
      float value = 0.0f;
      std::memcpy(&value, &array.bytes[i * array.stride + c * sizeof(float)], sizeof(float));
      low[c] = std::min(low[c], value);
      high[c] = std::max(high[c], value);
    }
  }
  if (accessor.contains("min")) accessor["min"] = low;
  if (accessor.contains("max")) accessor["max"] = high;
}

class DracoFiller {
 public:
  DracoFiller(GltfDocument& document, DecodedBytes& decoded, Warnings& warnings)
      : document_(document), decoded_(decoded), warnings_(warnings), file_(document.path.string()) {
    for (const Json& view : document.json.value("bufferViews", Json::array())) {
      const bool there = view.value("buffer", missingBuffer) != missingBuffer;
      compressed_.emplace_back(view.value("byteOffset", std::size_t{0}),
                               there ? view.value("byteLength", std::size_t{0}) : 0);
    }
    findReferences();
  }

  void fill(std::size_t mesh, std::size_t primitive) {
    place_ = fmt::format("/meshes/{}/primitives/{}", mesh, primitive);
    const Json::json_pointer pointer(place_);
    const Json draco = document_.json.at(pointer).at("extensions").at(dracoExtension);
    const auto view = static_cast<std::size_t>(*unsignedValue(draco.at("bufferView")));
    const std::string where = file_ + ": " + place_ + "/extensions/" + dracoExtension;
    std::set<std::string> filled;
    for (const auto& [name, number] : draco.at("attributes").items()) {
      fillAttribute(pointer, name, {view, static_cast<std::uint32_t>(*unsignedValue(number)), 0, 0}, where);
      filled.insert(name);
    }
    fillIndices(pointer, {view, std::nullopt, 0, 1});
    if (!vertices_.contains(view)) (void)meshOf(view, where);
    checkOthers(pointer, filled, vertices_.at(view));
    document_.json.at(pointer)["mode"] = drawsTriangles;
    dropExtension(document_.json.at(pointer), dracoExtension);
  }

 private:
  /// Notes the buffer views of accessors and images, whose bytes must be kept.
  void findReferences() {
    for (const char* list : {"accessors", "images"}) {
      for (const Json& holder : document_.json.value(list, Json::array())) {
        showView(holder);
        if (!holder.contains("sparse")) continue;
        for (const char* part : {"indices", "values"}) showView(holder.at("sparse").at(part));
      }
    }
  }

  void showView(const Json& holder) {
    if (const auto view = unsignedValue(holder.value("bufferView", Json()))) shown_.insert(*view);
  }

  const DracoMesh& meshOf(std::size_t view, const std::string& where) {
    if (mesh_ && meshView_ == view) return *mesh_;
    const auto [offset, length] = compressed_.at(view);
    if (length == 0) throw InputError(where, fmt::format("buffer view {} has no data", view));
    mesh_.reset();
    mesh_ = decodeDraco(std::span(document_.bin).subspan(offset, length), decoded_.left(), where);
    meshView_ = view;
    constexpr std::uint64_t triangleBytes = 12;
    decoded_.take(mesh_->triangles() * triangleBytes, where);
    vertices_[view] = mesh_->vertices();
    return *mesh_;
  }

  void fillAttribute(const Json::json_pointer& primitive, const std::string& name, DracoSource source,
                     const std::string& where) {
    Json& reference = document_.json.at(primitive).at("attributes").at(name);
    const auto index = static_cast<std::size_t>(*unsignedValue(reference));
    const Json& accessor = document_.json.at("accessors").at(index);
    source.componentType = *unsignedValue(accessor.at("componentType"));
    source.components = componentCount(accessor.at("type").get<std::string>());
    reference = filledAccessor(index, source, [&] {
      const DracoMesh& mesh = meshOf(source.view, where);
      const std::size_t stride = source.components * componentBytes(source.componentType);
      decoded_.take(std::uint64_t{mesh.vertices()} * ((stride + 3) / 4 * 4), where);
      return alignedVertices(
          {mesh.values({*source.attribute, source.componentType, source.components}, where), mesh.vertices(),
           stride, source.componentType, source.components});
    });
  }

  void fillIndices(const Json::json_pointer& primitive, DracoSource source) {
    if (!document_.json.at(primitive).contains("indices")) {
      document_.json.at(primitive)["indices"] = document_.json["accessors"].size();
      document_.json["accessors"].push_back(
          {{"componentType", indexBytes4}, {"count", 0}, {"type", "SCALAR"}});
    }
    Json& reference = document_.json.at(primitive).at("indices");
    const auto index = static_cast<std::size_t>(*unsignedValue(reference));
    source.componentType = *unsignedValue(document_.json.at("accessors").at(index).at("componentType"));
    const std::string where = file_ + ": " + place_ + "/indices";
    reference = filledAccessor(index, source, [&] {
      const DracoMesh& mesh = meshOf(source.view, where);
      decoded_.take(mesh.triangles() * 3 * sizeof(std::uint32_t), where);
      return indexArray(mesh, source.componentType);
    });
  }

  /// Returns the accessor for `source`: `index`, or another one if that has other data already.
  template <class Make>
  std::size_t filledAccessor(std::size_t index, const DracoSource& source, Make make) {
    if (const auto known = accessorOf_.find({index, source}); known != accessorOf_.end())
      return known->second;
    std::size_t target = index;
    if (!taken_.insert(index).second) {
      target = document_.json["accessors"].size();
      document_.json["accessors"].push_back(Json(document_.json["accessors"][index]));
    }
    const StoredArray array = make();
    Json& accessor = document_.json["accessors"][target];
    const std::size_t stated = accessor.value("count", array.count);
    if (stated != array.count && stated != 0)
      warnings_.push_back(
          fmt::format("{}: /accessors/{}/count: the Draco data hold {} elements, the file says {}", file_,
                      target, array.count, stated));
    accessor["count"] = array.count;
    accessor["componentType"] = array.componentType;
    accessor["bufferView"] = storeArray(array, source);
    accessor.erase("byteOffset");
    accessor.erase("sparse");  // the values that they replaced are gone
    setLimits(accessor, array);
    return accessorOf_[{index, source}] = target;
  }

  /// Returns a new buffer view of the bytes: it reuses that of the compressed bytes once, so that no unused
  /// view remains.
  std::size_t storeArray(const StoredArray& array, const DracoSource& source) {
    constexpr int vertexTarget = 34962, indexTarget = 34963;
    const std::size_t offset = appendBytes(document_, array.bytes);
    auto& views = document_.json["bufferViews"];
    Json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", array.bytes.size()}};
    const std::size_t tight = array.components * componentBytes(array.componentType);
    if (array.stride != tight) view["byteStride"] = array.stride;
    view["target"] = source.attribute ? vertexTarget : indexTarget;
    if (shown_.insert(source.view).second) {
      views[source.view] = std::move(view);
      return source.view;
    }
    views.push_back(std::move(view));
    return views.size() - 1;
  }

  /// Uncompressed attributes of the primitive are in the decoder's order of vertices.
  void checkOthers(const Json::json_pointer& primitive, const std::set<std::string>& filled,
                   std::size_t vertices) {
    for (const auto& [name, reference] : document_.json.at(primitive).at("attributes").items()) {
      const std::size_t count =
          document_.json.at("accessors").at(reference.get<std::size_t>()).at("count").get<std::size_t>();
      if (!filled.contains(name) && count != vertices)
        throw InputError(file_ + ": " + place_ + "/attributes/" + name,
                         fmt::format("{} vertices, but the Draco data have {}", count, vertices));
    }
  }

  GltfDocument& document_;
  DecodedBytes& decoded_;
  Warnings& warnings_;
  std::string file_;
  std::string place_;  ///< JSON pointer of the primitive
  std::vector<std::pair<std::size_t, std::size_t>>
      compressed_;               ///< original offset and length of the compressed views
  std::set<std::size_t> shown_;  ///< buffer views whose bytes must be kept
  std::set<std::size_t> taken_;  ///< accessors that are filled already
  std::map<std::pair<std::size_t, DracoSource>, std::size_t> accessorOf_;
  std::unique_ptr<DracoMesh> mesh_;
  std::size_t meshView_ = 0;
  std::map<std::size_t, std::size_t> vertices_;  ///< number of vertices in the views that were decoded
};

}  // namespace

void validateDraco(const JsonCursor& root, const JsonCursor& primitive) {
  const auto draco = dracoOf(primitive);
  if (!draco) return;
  const JsonCursor view = draco->at("bufferView");
  validateBufferView(root,
                     root.at("bufferViews").at(view.asIndex(root.countOf("bufferViews"), "buffer view")));
  const std::uint64_t mode = primitive.unsignedOr("mode", drawsTriangles);
  if (mode != drawsTriangles && mode != drawsStrip)
    primitive.at("mode").fail(fmt::format("expected 4 or 5 of what Draco compressed, got {}", mode));
  const JsonCursor attributes = primitive.at("attributes");
  draco->at("attributes").forEachMember([&](const JsonCursor& number, const std::string& name) {
    if (number.asUnsigned() > std::numeric_limits<std::uint32_t>::max())
      number.fail("expected an attribute's number in 32 bits");
    if (!attributes.find(name)) number.fail("the primitive has no attribute of that name");
    const JsonCursor accessor = root.at("accessors").at(attributes.at(name).asUnsigned());
    validateAccessor(root, accessor, true);
  });
}

void decodeDracoPrimitives(GltfDocument& document, DecodedBytes& decoded, Warnings& warnings) {
  const std::string file = document.path.string();
  const bool required = isRequired(document.json);
  DracoFiller filler(document, decoded, warnings);
  const std::size_t meshes = document.json.value("meshes", Json::array()).size();
  for (std::size_t m = 0; m < meshes; ++m) {
    const std::size_t primitives = document.json["meshes"][m]["primitives"].size();
    for (std::size_t p = 0; p < primitives; ++p) {
      const JsonCursor primitive = JsonCursor(file, document.json).at("meshes").at(m).at("primitives").at(p);
      const auto draco = dracoOf(primitive);
      if (!draco) continue;
      if (!required && isFallbackThere(document, primitive, *draco)) {
        dropExtension(document.json["meshes"][m]["primitives"][p], dracoExtension);
      } else {
        filler.fill(m, p);
      }
    }
  }
}

}  // namespace prelight

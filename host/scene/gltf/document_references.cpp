#include "scene/gltf/document_references.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf/gltf_embed.h"
#include "scene/gltf/gltf_validate.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 5> accessorMembers = {"indices", "input", "output",
                                                             "inverseBindMatrices", "accessor"};

/// Buffer views of property tables.
constexpr std::string_view metadataExtension = "EXT_structural_metadata";
constexpr std::array<std::string_view, 3> metadataMembers = {"values", "arrayOffsets", "stringOffsets"};

/// Extensions that the loader does not read, but whose references are visited, or which have none.
constexpr std::array<std::string_view, 6> harmlessExtensions = {metadataExtension,       "EXT_mesh_features",
                                                                "EXT_instance_features", "KHR_xmp_json_ld",
                                                                "KHR_node_visibility",   "MOZ_lightmap"};

template <std::size_t Count>
bool isAmong(const std::array<std::string_view, Count>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool isReference(std::string_view member, Reference kind, bool isMetadata) {
  if (kind == Reference::Accessor) return isAmong(accessorMembers, member);
  return member == "bufferView" || (isMetadata && isAmong(metadataMembers, member));
}

/// Does forEachReference() within an extension for metadata, or elsewhere.
void visitReferences(Json& json, Reference kind, bool isMetadata, const std::function<void(Json&)>& visit) {
  for (const auto& member : json.items()) {
    Json& value = member.value();
    if (json.is_object() && isReference(member.key(), kind, isMetadata) && unsignedValue(value)) visit(value);
    if (!value.is_structured() || member.key() == "extras") continue;
    visitReferences(value, kind, isMetadata || member.key() == metadataExtension, visit);
    const bool attributes = member.key() == "attributes";
    if (kind == Reference::BufferView || !(attributes || member.key() == "targets")) continue;
    const auto visitSet = [&](Json& set) {
      if (!set.is_structured()) return;
      for (Json& item : set)
        if (unsignedValue(item)) visit(item);
    };
    if (attributes)
      visitSet(value);
    else
      for (Json& set : value) visitSet(set);
  }
}

/// Returns whether a document may have references that forEachReference() does not visit.
bool mayHaveOthers(const Json& json) {
  if (!json.contains("extensionsUsed")) return false;
  const Json& used = json["extensionsUsed"];
  return std::any_of(used.begin(), used.end(), [](const Json& name) {
    return !name.is_string() || (!isKnownExtension(name.get<std::string>()) &&
                                 !isAmong(harmlessExtensions, name.get<std::string>()));
  });
}

/// Keeps the elements of a list that are referred to, and updates the references to their new indices.
void keepReferred(Json& json, const char* list, Reference kind) {
  if (!json.contains(list)) return;
  const std::set<std::size_t> used = referencesIn(json, kind);
  std::vector<std::size_t> place(json[list].size());
  Json kept = Json::array();
  for (std::size_t i = 0; i < json[list].size(); ++i) {
    place[i] = kept.size();
    if (used.contains(i)) kept.push_back(std::move(json[list][i]));
  }
  if (kept.size() == json[list].size()) {
    json[list] = std::move(kept);
    return;
  }
  forEachReference(json, kind, [&](Json& index) {
    if (const auto old = unsignedValue(index); old && *old < place.size()) index = place[*old];
  });
  if (kept.empty())
    json.erase(list);
  else
    json[list] = std::move(kept);
}

/// Moves the bytes of all buffer views together, each aligned to 8 bytes.
void closeGaps(GltfDocument& document) {
  constexpr std::size_t alignment = 8;
  std::vector<std::uint8_t> bin;
  if (document.json.contains("bufferViews")) {
    for (Json& view : document.json["bufferViews"]) {
      const auto offset = view.value("byteOffset", std::size_t{0});
      const auto length = view.value("byteLength", std::size_t{0});
      if (unsignedValue(view.value("buffer", Json())) != 0u || offset > document.bin.size() ||
          length > document.bin.size() - offset)
        continue;  // broken, and nothing uses it
      bin.resize((bin.size() + alignment - 1) / alignment * alignment, 0);
      view["byteOffset"] = bin.size();
      bin.insert(bin.end(), document.bin.begin() + static_cast<std::ptrdiff_t>(offset),
                 document.bin.begin() + static_cast<std::ptrdiff_t>(offset + length));
    }
  }
  document.bin = std::move(bin);
  updateBufferLength(document);
}

}  // namespace

void forEachReference(Json& json, Reference kind, const std::function<void(Json&)>& visit) {
  visitReferences(json, kind, false, visit);
}

std::set<std::size_t> referencesIn(Json& json, Reference kind) {
  std::set<std::size_t> references;
  forEachReference(json, kind, [&](const Json& index) { references.insert(*unsignedValue(index)); });
  return references;
}

void removeUnused(GltfDocument& document) {
  if (mayHaveOthers(document.json)) return;
  keepReferred(document.json, "accessors", Reference::Accessor);
  keepReferred(document.json, "bufferViews", Reference::BufferView);
  closeGaps(document);
}

}  // namespace prelight

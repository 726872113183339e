#include "io/baked_strip.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "io/values/quantized_column.h"
#include "io/values/value_reader.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/document_references.h"
#include "scene/gltf/gltf_embed.h"
#include "scene/gltf/json_cursor.h"
#include "techniques/registry/registry.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

using Names = std::set<std::string, std::less<>>;

/// Returns the members of the extension, at any depth, whose values are accessors.
Names accessorMembers() {
  Names names(std::begin(quantizedAccessors), std::end(quantizedAccessors));
  for (const Technique& technique : techniques())
    names.insert(technique.file.accessors.begin(), technique.file.accessors.end());
  return names;
}

void collectBaked(const Json& json, const Names& names, std::set<std::size_t>& accessors) {
  for (const auto& member : json.items()) {
    if (json.is_object() && names.contains(member.key()) && unsignedValue(member.value())) {
      accessors.insert(*unsignedValue(member.value()));
    } else if (member.value().is_structured()) {
      collectBaked(member.value(), names, accessors);
    }
  }
}

/// Removes PRELIGHT_transfer from an object and collects the accessors it refers to.
void takeExtension(Json& object, const Names& names, std::set<std::size_t>& accessors) {
  if (!object.is_object() || !object.contains("extensions") || !object["extensions"].is_object()) return;
  Json& extensions = object["extensions"];
  if (!extensions.contains(transferExtensionName)) return;
  collectBaked(extensions[transferExtensionName], names, accessors);
  extensions.erase(transferExtensionName);
  if (extensions.empty()) object.erase("extensions");
}

/// Returns the value of a member that counts bytes, or 0 if it is missing.
std::size_t memberOf(const Json& view, const char* name) {
  return view.contains(name) ? unsignedValue(view[name]).value_or(0) : 0;
}

/// Returns whether a view is in buffer 0. Other views are broken and unused.
bool isOfBuffer(const Json& view) { return view.contains("buffer") && unsignedValue(view["buffer"]) == 0u; }

/// Returns the end of the bytes that the buffer views cover.
std::size_t reachedBytes(const Json& json) {
  std::size_t end = 0;
  if (!json.contains("bufferViews")) return end;
  for (const Json& view : json["bufferViews"]) {
    if (isOfBuffer(view)) end = std::max(end, memberOf(view, "byteOffset") + memberOf(view, "byteLength"));
  }
  return end;
}

/// Returns a member of an object, or nullptr if there is none or it is of another type.
const Json* find(const Json& json, const char* name, Json::value_t type) {
  if (!json.is_object()) return nullptr;
  const auto member = json.find(name);
  return member != json.end() && member->type() == type ? &*member : nullptr;
}

/// Returns the PRELIGHT_transfer object of a glTF object, or nullptr.
const Json* extensionOf(const Json& object) {
  const Json* extensions = find(object, "extensions", Json::value_t::object);
  return extensions ? find(*extensions, transferExtensionName, Json::value_t::object) : nullptr;
}

/// Returns the bytes of an accessor's elements, 0 for a broken one.
std::size_t bytesOfElements(const Json& accessor) {
  const Json* type = find(accessor, "type", Json::value_t::string);
  if (type == nullptr || !accessor.contains("componentType")) return 0;
  return memberOf(accessor, "count") *
         elementBytes(type->get<std::string>(), unsignedValue(accessor["componentType"]).value_or(0));
}

}  // namespace

QuantizedBytes quantizedBytes(const GltfDocument& document) {
  const Names names = accessorMembers();
  const Json* accessors = find(document.json, "accessors", Json::value_t::array);
  const Json* nodes = find(document.json, "nodes", Json::value_t::array);
  QuantizedBytes bytes;
  if (accessors == nullptr || nodes == nullptr) return bytes;
  const auto add = [&](const std::string& member, const Json& json) {
    std::set<std::size_t> found;
    collectBaked(json, names, found);
    for (const std::size_t index : found)
      if (index < accessors->size()) bytes[member] += bytesOfElements((*accessors)[index]);
  };
  for (const Json& node : *nodes) {
    const Json* extension = extensionOf(node);
    const Json* entries = extension ? find(*extension, "primitives", Json::value_t::array) : nullptr;
    if (entries == nullptr) continue;
    for (const Json& entry : *entries) {
      if (const Json* members = find(entry, "quantized", Json::value_t::object))
        for (const auto& member : members->items()) add(member.key(), Json{{member.key(), member.value()}});
      // Quantised records of vector occluders have a place of their own.
      const Json* occluders = find(entry, "vo", Json::value_t::object);
      if (occluders != nullptr && occluders->contains("bytes")) add("vo", *occluders);
    }
  }
  const Json* root = extensionOf(document.json);
  if (root != nullptr && root->contains("glossyCompressed")) add("glossy", root->at("glossyCompressed"));
  return bytes;
}

void stripBake(GltfDocument& document) {
  Json& json = document.json;
  const Names names = accessorMembers();
  std::set<std::size_t> baked;
  if (json.contains("nodes")) {
    for (Json& node : json["nodes"]) takeExtension(node, names, baked);
  }
  takeExtension(json, names, baked);
  if (baked.empty()) return;

  const std::set<std::size_t> keptAccessors = referencesIn(json, Reference::Accessor);
  std::set<std::size_t> views;
  Json& accessors = json["accessors"];
  while (!accessors.empty() && baked.contains(accessors.size() - 1) &&
         !keptAccessors.contains(accessors.size() - 1)) {
    if (const auto view = unsignedValue(accessors.back().value("bufferView", Json()))) views.insert(*view);
    accessors.erase(accessors.size() - 1);
  }
  const std::set<std::size_t> keptViews = referencesIn(json, Reference::BufferView);
  Json& bufferViews = json["bufferViews"];
  std::size_t start = document.bin.size();
  while (!bufferViews.empty() && views.contains(bufferViews.size() - 1) &&
         !keptViews.contains(bufferViews.size() - 1)) {
    if (isOfBuffer(bufferViews.back())) start = std::min(start, memberOf(bufferViews.back(), "byteOffset"));
    bufferViews.erase(bufferViews.size() - 1);
  }
  document.bin.resize(std::max(start, std::min(reachedBytes(json), document.bin.size())));
  if (accessors.empty()) json.erase("accessors");
  if (json["bufferViews"].empty()) json.erase("bufferViews");
  updateBufferLength(document);
}

}  // namespace prelight

#include "scene/gltf/gltf_document.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/files.h"
#include "prelight/error.h"
#include "scene/gltf/decompress.h"
#include "scene/gltf/glb_container.h"
#include "scene/gltf/gltf_embed.h"
#include "scene/gltf/gltf_oddities.h"
#include "scene/gltf/gltf_validate.h"
#include "scene/gltf/json_cursor.h"
#include "scene/gltf/listed_children.h"
#include "scene/gltf/other_formats.h"
#include "scene/gltf/uri.h"

namespace prelight {

GltfDocument readGltf(const std::filesystem::path& path, Warnings& warnings, const ReadOptions& options) {
  return parseGltf(readFileBytes(path, path.string()), path, warnings, options);
}

GltfDocument parseGltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& path,
                       Warnings& warnings, const ReadOptions& options) {
  const std::string file = path.string();
  if (bytes.empty()) throw InputError(file, "the file is empty, expected glTF");
  GlbChunks chunks;
  if (isGlb(bytes)) {
    chunks = splitGlb(bytes, file, warnings);
  } else {
    refuseOtherFormats(bytes, file);
    chunks.json = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  if (chunks.json.starts_with("\xEF\xBB\xBF"))
    warnings.push_back(file + ": a byte order mark before the JSON, expected none");
  GltfDocument document;
  document.path = path;
  document.outsideAllowed = options.allowOutside;
  document.json = parseJson(chunks.json, file);
  try {
    checkFileReferences(document);
    validateGltf(JsonCursor(file, document.json), warnings);
    if (options.tellOddities) warnOfOddities(document.json, file, warnings);
    settleListedChildren(document, warnings);
    embedBuffers(document, chunks.bin, warnings);
    decompress(document, warnings);
    validateBinaryData(document);
    embedImages(document, warnings);
    embedProfiles(document, warnings);
    if (options.tellOddities) warnOfOddValues(document, warnings);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file, error.what());
  }
  return document;
}

void writeGlb(const std::filesystem::path& path, const GltfDocument& document) {
  OutputFiles files;
  addGlb(files, path, document);
  files.commit();
}

namespace {

/// Returns the part of a .glb file before its binary data.
std::vector<std::uint8_t> prefixOf(const GltfDocument& document, const std::filesystem::path& path) {
  using Json = nlohmann::ordered_json;
  const std::string json = document.json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return makeGlbPrefix(json, document.bin.size(), path.string());
}

std::size_t paddingOf(const GltfDocument& document) { return (4 - document.bin.size() % 4) % 4; }

}  // namespace

std::uint64_t glbSize(const GltfDocument& document) {
  return prefixOf(document, document.path).size() + document.bin.size() + paddingOf(document);
}

void addGlb(OutputFiles& files, const std::filesystem::path& path, const GltfDocument& document) {
  const std::vector<std::uint8_t> prefix = prefixOf(document, path);
  const std::array<std::uint8_t, 3> zeros{};
  const std::array<std::span<const std::byte>, 3> pieces = {
      std::as_bytes(std::span(prefix)), std::as_bytes(std::span(document.bin)),
      std::as_bytes(std::span(zeros).first(paddingOf(document)))};
  files.add(path, pieces);
}

int appendAccessor(GltfDocument& document, std::span<const std::byte> data, const std::string& type,
                   int componentType, std::size_t count) {
  const std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(data.data()), data.size());
  const int view = appendBufferView(document, bytes);
  auto& accessors = document.json["accessors"];
  nlohmann::ordered_json accessor = {
      {"bufferView", view}, {"componentType", componentType}, {"count", count}, {"type", type}};
  accessors.push_back(std::move(accessor));
  return static_cast<int>(accessors.size()) - 1;
}

using Json = nlohmann::ordered_json;

void useExtensionName(Json& root, std::string_view name) {
  Json& used = root["extensionsUsed"];
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

void dropExtensionName(Json& root, std::string_view name) {
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    if (!root.contains(list)) continue;
    Json kept = Json::array();
    for (const Json& entry : root[list])
      if (entry != name) kept.push_back(entry);
    if (kept.empty())
      root.erase(list);
    else
      root[list] = std::move(kept);
  }
}

}  // namespace prelight

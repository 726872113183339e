#include "scene/gltf/decompress.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "prelight/error.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/draco_primitives.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/gltf_embed.h"
#include "scene/gltf/gltf_use.h"
#include "scene/gltf/gltf_validate.h"
#include "scene/gltf/json_cursor.h"
#include "scene/gltf/meshopt_views.h"

namespace prelight {

DecodedBytes::DecodedBytes(std::uint64_t documentBytes)
    : left_((std::uint64_t{1} << 26) + 256 * documentBytes) {}

void DecodedBytes::take(std::uint64_t bytes, const std::string& where) {
  if (bytes > left_)
    throw InputError(
        where,
        fmt::format("decoding takes {} bytes, expected at most {} more for so small a file", bytes, left_),
        "the data are damaged, or export the scene without compression");
  left_ -= bytes;
}

namespace {

using Json = nlohmann::ordered_json;

bool isDraco(const Json& primitive) {
  const auto extensions = primitive.find("extensions");
  return extensions != primitive.end() && extensions->is_object() && extensions->contains(dracoExtension);
}

/// Returns true when a validated document has compressed parts.
bool isCompressed(const Json& root) {
  if (root.contains("bufferViews")) {
    for (const Json& view : root.at("bufferViews")) {
      if (!meshoptExtensionOf(view).empty()) return true;
    }
  }
  if (!root.contains("meshes")) return false;
  for (const Json& mesh : root.at("meshes")) {
    const Json& primitives = mesh.at("primitives");
    if (std::any_of(primitives.begin(), primitives.end(), isDraco)) return true;
  }
  return false;
}

/// Removes the extensions that the file no longer uses.
void dropNames(Json& root) {
  for (const char* name : {dracoExtension, "EXT_meshopt_compression", "KHR_meshopt_compression"})
    dropExtensionName(root, name);
}

/// Bytes [first, second) of `bin`.
using Range = std::pair<std::size_t, std::size_t>;

Range rangeOf(const Json& view) {
  const std::size_t offset = view.value("byteOffset", std::size_t{0});
  return {offset, offset + view.at("byteLength").get<std::size_t>()};
}

bool hasData(const Json& view) { return view.at("buffer") != missingBuffer; }

/// Drops the bytes that no buffer view refers to any more. Views that share bytes continue to do so.
void dropUnseenBytes(GltfDocument& document) {
  if (!document.json.contains("bufferViews")) return;
  Json& views = document.json["bufferViews"];
  std::vector<Range> ranges;
  for (const Json& view : views) {
    if (hasData(view)) ranges.push_back(rangeOf(view));
  }
  std::sort(ranges.begin(), ranges.end());
  constexpr std::size_t alignment = 16;
  std::vector<std::uint8_t> kept;
  // New place of the bytes that begin there, up to the next entry.
  std::map<std::size_t, std::size_t> placeOf;
  std::size_t end = 0;
  for (const auto& [first, last] : ranges) {
    if (placeOf.empty() || first > end) {
      while (kept.size() % alignment != first % alignment) kept.push_back(0);
      placeOf[first] = kept.size();
      end = first;
    }
    if (last <= end) continue;
    kept.insert(kept.end(), document.bin.begin() + static_cast<std::ptrdiff_t>(end),
                document.bin.begin() + static_cast<std::ptrdiff_t>(last));
    end = last;
  }
  for (Json& view : views) {
    if (!hasData(view)) continue;
    const std::size_t first = rangeOf(view).first;
    const auto piece = std::prev(placeOf.upper_bound(first));
    view["byteOffset"] = piece->second + (first - piece->first);
  }
  document.bin = std::move(kept);
  updateBufferLength(document);
}

/// Checks meshes and skins again: accessors now have the counts of the Draco data, and others may share them.
void checkCounts(const GltfDocument& document) {
  const std::string file = document.path.string();
  const JsonCursor root(file, document.json);
  validateMeshes(root);
  Warnings told;  // these warnings were given when the file was read
  validateSkins(root, findUse(document.json), told);
}

}  // namespace

void decompress(GltfDocument& document, Warnings& warnings) {
  if (!isCompressed(document.json)) return;
  DecodedBytes decoded(document.bin.size());
  decodeMeshoptViews(document, decoded, warnings);
  decodeDracoPrimitives(document, decoded, warnings);
  checkCounts(document);
  dropNames(document.json);
  dropUnseenBytes(document);
}

}  // namespace prelight

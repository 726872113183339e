#include "scene/gltf/meshopt_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "scene/codecs/meshopt_stream.h"
#include "scene/gltf/gltf_embed.h"
#include "scene/gltf/gltf_use.h"
#include "scene/gltf/gltf_validate.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 3> meshoptModes = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
constexpr std::array<std::string_view, 5> meshoptFilters = {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL",
                                                            "COLOR"};

/// Returns the index of a word in a list; fails for an unknown word.
template <std::size_t N>
std::size_t placeOfWord(const JsonCursor& word, const std::array<std::string_view, N>& words) {
  const auto found = std::find(words.begin(), words.end(), word.asString());
  if (found == words.end())
    word.fail(fmt::format("expected one of {}, got \"{}\"", fmt::join(words, ", "), word.asString()));
  return static_cast<std::size_t>(found - words.begin());
}

MeshoptLayout layoutOf(const JsonCursor& extension) {
  MeshoptLayout layout;
  layout.mode = static_cast<MeshoptMode>(placeOfWord(extension.at("mode"), meshoptModes));
  if (const auto filter = extension.find("filter"))
    layout.filter = static_cast<MeshoptFilter>(placeOfWord(*filter, meshoptFilters));
  layout.count = extension.at("count").asUnsigned();
  layout.stride = extension.at("byteStride").asUnsigned();
  return layout;
}

/// Checks strides and counts as the extension requires.
void checkLayout(const JsonCursor& extension, const MeshoptLayout& layout) {
  const JsonCursor stride = extension.at("byteStride");
  const JsonCursor count = extension.at("count");
  const auto expectStride = [&](bool fits, const char* expected) {
    if (!fits) stride.fail(fmt::format("expected {}, got {}", expected, layout.stride));
  };
  if (layout.count == 0) count.fail("expected a positive integer, got 0");
  if (layout.mode != MeshoptMode::Attributes) {
    expectStride(layout.stride == 2 || layout.stride == 4, "2 or 4 for indices");
    if (layout.filter != MeshoptFilter::None) extension.at("filter").fail("expected NONE for indices");
    if (layout.mode == MeshoptMode::Triangles && layout.count % 3 != 0)
      count.fail(fmt::format("expected a multiple of 3 for triangles, got {}", layout.count));
    return;
  }
  expectStride(layout.stride % 4 == 0 && layout.stride >= 4 && layout.stride <= 256,
               "a multiple of 4 in 4..256");
  if (layout.filter == MeshoptFilter::Octahedral || layout.filter == MeshoptFilter::Color)
    expectStride(layout.stride == 4 || layout.stride == 8, "4 or 8 with this filter");
  if (layout.filter == MeshoptFilter::Quaternion) expectStride(layout.stride == 8, "8 with this filter");
}

/// Decodes one view and removes its extension; its bytes are appended to the document's.
void decodeView(GltfDocument& document, std::size_t index, DecodedBytes& decoded) {
  const std::string file = document.path.string();
  const JsonCursor root(file, document.json);
  const JsonCursor view = root.at("bufferViews").at(index);
  const JsonCursor extension = *meshoptOf(view);
  validateMeshopt(root, view);
  const MeshoptLayout layout = layoutOf(extension);
  const auto stream =
      std::span(document.bin)
          .subspan(extension.unsignedOr("byteOffset", 0), extension.at("byteLength").asUnsigned());
  decoded.take(layout.bytes(), extension.where());
  const std::vector<std::uint8_t> bytes = decodeMeshopt(stream, layout, extension.where());
  const std::size_t offset = appendBytes(document, bytes);
  auto& json = document.json["bufferViews"][index];
  json["buffer"] = 0;
  json["byteOffset"] = offset;
}

}  // namespace

std::string meshoptExtensionOf(const Json& view) {
  if (!view.is_object()) return {};
  const auto extensions = view.find("extensions");
  if (extensions == view.end() || !extensions->is_object()) return {};
  for (const char* name : {"KHR_meshopt_compression", "EXT_meshopt_compression"}) {
    if (extensions->contains(name)) return name;
  }
  return {};
}

void dropExtension(Json& holder, const std::string& name) {
  auto& extensions = holder["extensions"];
  extensions.erase(name);
  if (extensions.empty()) holder.erase("extensions");
}

std::optional<JsonCursor> meshoptOf(const JsonCursor& view) {
  const std::string name = meshoptExtensionOf(view.value());
  return name.empty() ? std::nullopt : std::optional(view.at("extensions").at(name));
}

void validateMeshopt(const JsonCursor& root, const JsonCursor& view) {
  const auto extension = meshoptOf(view);
  if (!extension) return;
  const std::size_t buffer = extension->at("buffer").asIndex(root.countOf("buffers"), "buffer");
  const std::uint64_t bufferBytes = root.at("buffers").at(buffer).at("byteLength").asUnsigned();
  const std::uint64_t offset = extension->unsignedOr("byteOffset", 0);
  const std::uint64_t length = extension->at("byteLength").asUnsigned();
  if (length == 0 || offset > bufferBytes || length > bufferBytes - offset)
    extension->fail(fmt::format("{} compressed bytes from offset {} do not lie in buffer {} of {} bytes",
                                length, offset, buffer, bufferBytes));
  const MeshoptLayout layout = layoutOf(*extension);
  checkLayout(*extension, layout);
  const std::uint64_t viewBytes = view.at("byteLength").asUnsigned();
  if (viewBytes % layout.stride != 0 || viewBytes / layout.stride != layout.count)
    extension->fail(fmt::format("{} elements of {} bytes, expected the {} bytes of the buffer view",
                                layout.count, layout.stride, viewBytes));
}

std::set<std::size_t> fallbackBuffers(const Json& root) {
  std::set<std::size_t> fallback;
  std::set<std::size_t> read;
  const auto addBuffer = [](const Json& holder, std::set<std::size_t>& buffers) {
    const auto index = holder.is_object() ? unsignedValue(holder.value("buffer", Json())) : std::nullopt;
    if (index) buffers.insert(*index);
  };
  const auto views = root.find("bufferViews");
  if (views == root.end() || !views->is_array()) return {};
  for (const Json& view : *views) {
    const std::string extension = meshoptExtensionOf(view);
    if (extension.empty()) {
      addBuffer(view, read);
    } else {
      addBuffer(view, fallback);
      addBuffer(view.at("extensions").at(extension), read);
    }
  }
  std::erase_if(fallback, [&](std::size_t index) { return read.contains(index); });
  return fallback;
}

void decodeMeshoptViews(GltfDocument& document, DecodedBytes& decoded, Warnings& warnings) {
  if (!document.json.contains("bufferViews")) return;
  const GltfUse use = findUse(document.json);
  const std::size_t count = document.json["bufferViews"].size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = meshoptExtensionOf(document.json["bufferViews"][i]);
    if (name.empty()) continue;
    checkPart(use.bufferViews.contains(i), warnings, [&] { decodeView(document, i, decoded); });
    dropExtension(document.json["bufferViews"][i], name);
  }
}

}  // namespace prelight

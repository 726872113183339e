#include "scene/gltf/gltf_embed.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "base/files.h"
#include "prelight/error.h"
#include "scene/codecs/ies_profile.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/gltf_validate.h"
#include "scene/gltf/image_decode.h"
#include "scene/gltf/json_cursor.h"
#include "scene/gltf/meshopt_views.h"
#include "scene/gltf/uri.h"

namespace prelight {

namespace fs = std::filesystem;

namespace {

/// Returns the bytes of a URI, at most `limit` for a file. Throws InputError.
std::vector<std::uint8_t> readUri(const GltfDocument& document, const JsonCursor& uri, std::uint64_t limit) {
  const std::string& text = uri.asString();
  if (isDataUri(text)) {
    std::optional<DataUri> data = parseDataUri(text);
    if (!data) uri.fail("malformed data URI, expected data:[MIME][;base64],DATA");
    return std::move(data->bytes);
  }
  // One letter before the colon is a drive of the file system, not a scheme.
  if (const std::string scheme = uriScheme(text); scheme.size() > 1) {
    uri.fail(fmt::format("URI scheme \"{}\" is not supported", scheme), "put the file beside the scene");
  }
  return readFileBytes(referencedFile(document, uri), uri.where(), limit);
}

void alignTo4(std::vector<std::uint8_t>& bytes) { bytes.resize((bytes.size() + 3) / 4 * 4); }

/// Returns the bytes of buffer `index`, exactly byteLength of them.
std::vector<std::uint8_t> readBuffer(const GltfDocument& document, const JsonCursor& buffer,
                                     std::size_t index, std::optional<std::span<const std::uint8_t>> glbBin) {
  const std::uint64_t length = buffer.at("byteLength").asUnsigned();
  std::vector<std::uint8_t> bytes;
  if (const auto uri = buffer.find("uri")) {
    bytes = readUri(document, *uri, length);
  } else if (index == 0 && glbBin) {
    bytes.assign(glbBin->begin(), glbBin->begin() + std::min<std::uint64_t>(length, glbBin->size()));
  }
  if (bytes.size() < length) {
    buffer.at("byteLength")
        .fail(fmt::format("expected {} bytes, got {}", length, bytes.size()),
              "the buffer is truncated; copy or export it again");
  }
  bytes.resize(length);
  return bytes;
}

/// Returns true for a buffer without data, which glTF leaves to the application.
bool isPlaceholder(const JsonCursor& buffer) {
  const auto length = buffer.find("byteLength");
  return !buffer.find("uri") && length && unsignedValue(length->value()).value_or(0) > 0;
}

/// Offsets of the buffers in `bin`; nullopt for a buffer that could not be read.
using BufferOffsets = std::vector<std::optional<std::size_t>>;

bool isUsable(const JsonCursor& root, const JsonCursor& view, const BufferOffsets& offsets) {
  try {
    validateBufferView(root, view);
  } catch (const InputError&) {
    return false;
  }
  const auto compressed = meshoptOf(view);
  return offsets[(compressed ? *compressed : view).at("buffer").asUnsigned()].has_value();
}

/// Redirects a view to `bin`. One that is broken, or whose buffer is, must not refer to other data in `bin`.
/// A compressed one has no data until it is decoded.
void moveView(nlohmann::ordered_json& view, bool usable, const BufferOffsets& offsets) {
  const std::string extension = meshoptExtensionOf(view);
  nlohmann::ordered_json& source = extension.empty() ? view : view["extensions"][extension];
  if (usable) {
    const std::size_t offset = *offsets[*unsignedValue(source.at("buffer"))];
    source["buffer"] = 0;
    if (offset > 0) source["byteOffset"] = offset + source.value("byteOffset", std::size_t{0});
  }
  if (!usable || !extension.empty()) view["buffer"] = missingBuffer;
  if (!usable && !extension.empty()) dropExtension(view, extension);
}

/// Returns the buffer view of an image given by URI. Equal URIs are embedded once.
int embedImage(GltfDocument& document, const JsonCursor& image, std::string& mimeType) {
  const JsonCursor uri = image.at("uri");
  std::vector<std::uint8_t> bytes = readUri(document, uri, UINT64_MAX);
  if (bytes.empty()) uri.fail("the image is empty");
  mimeType = imageMimeType(bytes);
  if (mimeType.empty() && isDataUri(uri.asString())) mimeType = parseDataUri(uri.asString())->mimeType;
  if (mimeType.empty()) mimeType = "application/octet-stream";
  return appendBufferView(document, bytes);
}

}  // namespace

void embedBuffers(GltfDocument& document, std::optional<std::span<const std::uint8_t>> glbBin,
                  Warnings& warnings) {
  const std::string file = document.path.string();
  const JsonCursor root(file, document.json);
  const GltfUse use = findUse(document.json);
  const std::set<std::size_t> fallback = fallbackBuffers(document.json);
  BufferOffsets offsets;
  root.forEachObject("buffers", [&](const JsonCursor& buffer, std::size_t index) {
    alignTo4(document.bin);
    offsets.emplace_back();
    if (fallback.contains(index)) return;
    if (isPlaceholder(buffer) && !(index == 0 && glbBin)) {
      warnings.push_back(buffer.where() +
                         ": it has neither a URI nor the file's binary chunk; its contents are left out");
      return;
    }
    checkPart(use.buffers.contains(index), warnings, [&] {
      const std::vector<std::uint8_t> bytes = readBuffer(document, buffer, index, glbBin);
      offsets.back() = document.bin.size();
      document.bin.insert(document.bin.end(), bytes.begin(), bytes.end());
    });
  });
  if (document.json.contains("bufferViews")) {
    std::vector<bool> usable;
    root.forEachObject("bufferViews", [&](const JsonCursor& view, std::size_t) {
      usable.push_back(isUsable(root, view, offsets));
    });
    for (std::size_t i = 0; i < usable.size(); ++i)
      moveView(document.json["bufferViews"][i], usable[i], offsets);
  }
  updateBufferLength(document);
}

void embedImages(GltfDocument& document, Warnings& warnings) {
  if (!document.json.contains("images")) return;
  const std::string file = document.path.string();
  struct Embedded {
    int bufferView;
    std::string mimeType;
  };
  std::map<std::string, Embedded> embedded;
  const std::size_t count = document.json["images"].size();
  for (std::size_t i = 0; i < count; ++i) {
    const JsonCursor image = JsonCursor(file, document.json).at("images").at(i);
    const auto named = image.find("uri");
    if (!named || !named->value().is_string()) continue;
    const std::string uri = image.at("uri").asString();
    auto known = embedded.find(uri);
    if (known == embedded.end()) {
      try {
        Embedded fresh{};
        fresh.bufferView = embedImage(document, image, fresh.mimeType);
        known = embedded.emplace(uri, fresh).first;
      } catch (const InputError& error) {
        warnings.push_back(fmt::format("{}; a white texel stands in for the image", error.what()));
        continue;
      }
    }
    auto& json = document.json["images"][i];
    json.erase("uri");
    json["mimeType"] = known->second.mimeType;
    json["bufferView"] = known->second.bufferView;
  }
}

void embedProfiles(GltfDocument& document, Warnings& warnings) {
  const std::string file = document.path.string();
  const auto profilesOf = [&]() -> nlohmann::ordered_json* {
    const auto extensions = document.json.find("extensions");
    if (extensions == document.json.end() || !extensions->contains("EXT_lights_ies")) return nullptr;
    nlohmann::ordered_json& extension = (*extensions)["EXT_lights_ies"];
    return extension.contains("lights") ? &extension["lights"] : nullptr;
  };
  if (profilesOf() == nullptr) return;
  const GltfUse use = findUse(document.json);
  std::map<std::string, int> embedded;  // buffer views by URI
  std::size_t total = 0;
  for (std::size_t i = 0; i < profilesOf()->size(); ++i) {
    if (!(*profilesOf())[i].contains("uri") || (*profilesOf())[i].contains("bufferView")) continue;
    checkPart(use.profiles.contains(i), warnings, [&] {
      const JsonCursor profile =
          JsonCursor(file, document.json).at("extensions").at("EXT_lights_ies").at("lights").at(i);
      const std::string uri = profile.at("uri").asString();
      if (!embedded.contains(uri)) {
        const std::vector<std::uint8_t> bytes = readUri(document, profile.at("uri"), mostProfileBytes);
        if (bytes.size() > mostProfilesBytes - total)
          profile.at("uri").fail(
              fmt::format("the scene's profiles up to this one have {} bytes, expected at most {} together",
                          total + bytes.size(), mostProfilesBytes),
              "use fewer profiles, or ones of fewer angles");
        total += bytes.size();
        embedded[uri] = appendBufferView(document, bytes);
      }
      nlohmann::ordered_json& json = (*profilesOf())[i];
      json.erase("uri");
      json["mimeType"] = "application/x-ies-lm-63";
      json["bufferView"] = embedded.at(uri);
    });
  }
}

void updateBufferLength(GltfDocument& document) {
  if (document.bin.empty()) {
    document.json.erase("buffers");
  } else {
    document.json["buffers"] = {{{"byteLength", document.bin.size()}}};
  }
}

std::size_t appendBytes(GltfDocument& document, std::span<const std::uint8_t> bytes) {
  alignTo4(document.bin);
  const std::size_t offset = document.bin.size();
  document.bin.insert(document.bin.end(), bytes.begin(), bytes.end());
  updateBufferLength(document);
  return offset;
}

int appendBufferView(GltfDocument& document, std::span<const std::uint8_t> bytes) {
  const std::size_t offset = appendBytes(document, bytes);
  auto& views = document.json["bufferViews"];
  nlohmann::ordered_json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}};
  views.push_back(std::move(view));
  return static_cast<int>(views.size()) - 1;
}

}  // namespace prelight

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// Decodes "%20" to " ". A percent sign that two hexadecimal digits do not follow is kept.
std::string percentDecode(std::string_view text);

/// Returns the bytes of a base64 text; white space and missing padding are tolerated. nullopt for any other
/// character.
std::optional<std::vector<std::uint8_t>> decodeBase64(std::string_view text);

/// The content of a data URI.
struct DataUri {
  std::string mimeType;  ///< may be empty
  std::vector<std::uint8_t> bytes;
};

bool isDataUri(std::string_view uri);

/// Decodes "data:[MIME][;parameters][;base64],DATA"; nullopt when it is malformed.
std::optional<DataUri> parseDataUri(std::string_view uri);

/// Returns the scheme of "scheme:rest" in lower case; empty for a relative reference.
std::string uriScheme(std::string_view uri);

/// Returns the file that a relative URI of a document names. Throws InputError naming the URI's place unless
/// - the name is one that a file can have, and
/// - the file lies in the document's folder or below, symbolic links followed, or may lie elsewhere
///   (ReadOptions), and
/// - what exists there, if anything, is a file or a folder: never a device, a pipe or a socket.
std::filesystem::path referencedFile(const GltfDocument& document, const JsonCursor& uri);

/// Throws InputError where a buffer, an image, a lamp's profile or a light map, used or not, names a file
/// that referencedFile refuses. Ignores data URIs and URIs with a scheme.
void checkFileReferences(const GltfDocument& document);

}  // namespace prelight

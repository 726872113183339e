#pragma once

#include <filesystem>

#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

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

#pragma once

#include "prelight/error.h"
#include "scene/gltf/decompress.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

constexpr const char* dracoExtension = "KHR_draco_mesh_compression";

/// Checks this extension of a mesh primitive, if it has it. Throws InputError.
void validateDraco(const JsonCursor& root, const JsonCursor& primitive);

/// Fills the accessors of every primitive that is compressed with Draco, in the decoder's order of vertices,
/// and removes the extension. Primitives that have uncompressed data as well keep it. The document's buffers
/// must be embedded. Throws InputError.
void decodeDracoPrimitives(GltfDocument& document, DecodedBytes& decoded, Warnings& warnings);

}  // namespace prelight

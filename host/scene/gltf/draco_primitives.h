#pragma once

#include "prelight/error.h"
#include "scene/gltf/decoded_bytes.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

constexpr const char* dracoExtension = "KHR_draco_mesh_compression";

/// Checks that extension of a mesh primitive, if it has it. Throws InputError.
void validateDraco(const JsonCursor& root, const JsonCursor& primitive);

/// Fills the accessors of every primitive that is compressed with Draco, in the decoder's order of vertices,
/// and takes the extension off. Primitives with uncompressed data beside keep those. The document's buffers
/// are embedded. Throws InputError.
void decodeDracoPrimitives(GltfDocument& document, DecodedBytes& decoded, Warnings& warnings);

}  // namespace prelight

#pragma once

#include "prelight/error.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Decodes the compressed parts of a document (EXT_meshopt_compression, KHR_meshopt_compression,
/// KHR_draco_mesh_compression) once its buffers are embedded: all further code, and every file written from
/// it, handle plain accessors only. Other documents are unchanged. Throws InputError.
void decompress(GltfDocument& document, Warnings& warnings);

}  // namespace prelight

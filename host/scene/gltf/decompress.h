#pragma once

#include "prelight/error.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Decodes what of a document is compressed (EXT_meshopt_compression, KHR_meshopt_compression,
/// KHR_draco_mesh_compression), once its buffers are embedded: what follows, and every file that is written
/// of it, knows plain accessors alone. Other documents stay as they are. Throws InputError.
void decompress(GltfDocument& document, Warnings& warnings);

}  // namespace prelight

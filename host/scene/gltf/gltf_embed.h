#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "prelight/error.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Merges every buffer of a checked document (the binary chunk of its .glb, external files, data URIs) into
/// `bin`. Throws InputError when a buffer cannot be read or is shorter than it says; of one that is not used
/// that is a warning, and its buffer views then refer to a buffer that there is not.
void embedBuffers(GltfDocument& document, std::optional<std::span<const std::uint8_t>> glbBin,
                  Warnings& warnings);

/// Moves images named by URI into buffer views. One that cannot be read stays as it is, with a warning.
void embedImages(GltfDocument& document, Warnings& warnings);

/// Moves profiles of lamps that are named by URI into buffer views. Throws InputError when one cannot be read
/// that a node uses; another stays as it is, with a warning.
void embedProfiles(GltfDocument& document, Warnings& warnings);

/// Makes buffers[0] tell the size of `bin`; no buffers at all when that is empty.
void updateBufferLength(GltfDocument& document);

/// Appends bytes to `bin`, aligned to 4 bytes. Returns where they begin.
std::size_t appendBytes(GltfDocument& document, std::span<const std::uint8_t> bytes);

/// Appends bytes to `bin` in a buffer view of their own, aligned to 4 bytes. Returns its index.
int appendBufferView(GltfDocument& document, std::span<const std::uint8_t> bytes);

}  // namespace prelight

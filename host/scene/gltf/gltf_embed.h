#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "prelight/error.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Merges every buffer of a checked document (the binary chunk of its .glb, external files, data URIs) into
/// `bin`. Throws InputError when a buffer cannot be read or is too short. For an unused buffer that is only a
/// warning, and its buffer views then refer to a buffer that does not exist.
void embedBuffers(GltfDocument& document, std::optional<std::span<const std::uint8_t>> glbBin,
                  Warnings& warnings);

/// Moves images named by URI into buffer views. An image that cannot be read is left unchanged, with a
/// warning.
void embedImages(GltfDocument& document, Warnings& warnings);

/// Moves profiles of lamps named by URI into buffer views. Throws InputError when one that a node uses cannot
/// be read; an unused one is left unchanged, with a warning.
void embedProfiles(GltfDocument& document, Warnings& warnings);

/// Sets the size of buffers[0] to that of `bin`, and removes all buffers when `bin` is empty.
void updateBufferLength(GltfDocument& document);

/// Appends bytes to `bin`, aligned to 4 bytes. Returns their offset.
std::size_t appendBytes(GltfDocument& document, std::span<const std::uint8_t> bytes);

/// Appends bytes to `bin`, aligned to 4 bytes, in a new buffer view. Returns the view's index.
int appendBufferView(GltfDocument& document, std::span<const std::uint8_t> bytes);

}  // namespace prelight

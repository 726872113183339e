#pragma once

#include <cstdint>
#include <filesystem>

#include "base/atomic_file.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Returns the size in bytes of the file that writeGlb() makes.
std::uint64_t glbSize(const GltfDocument& document);

/// Adds the file that writeGlb() would write to a set of files that are written together.
void addGlb(OutputFiles& files, const std::filesystem::path& path, const GltfDocument& document);

}  // namespace prelight

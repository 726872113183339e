#pragma once

#include <cstdint>
#include <filesystem>

#include "base/atomic_file.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Bytes of the file that writeGlb() makes.
std::uint64_t glbSize(const GltfDocument& document);

/// writeGlb() as one of several files that belong together.
void addGlb(OutputFiles& files, const std::filesystem::path& path, const GltfDocument& document);

}  // namespace prelight

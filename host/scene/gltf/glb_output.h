#pragma once

#include <filesystem>

#include "base/atomic_file.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// writeGlb() as one of several files that belong together.
void addGlb(OutputFiles& files, const std::filesystem::path& path, const GltfDocument& document);

}  // namespace prelight

#pragma once

#include <filesystem>

#include "io/atomic_file.h"
#include "scene/gltf_document.h"

namespace prelight {

/// writeGlb() as one of several files that belong together.
void addGlb(OutputFiles& files, const std::filesystem::path& path, const GltfDocument& document);

}  // namespace prelight

#pragma once

#include <filesystem>
#include <vector>

#include "prelight/picture.h"

namespace prelight {

class OutputFiles;

/// Adds a picture to a set of files (base/atomic_file.h) that appear together. A .png omits the layers.
/// Throws UsageError for extensions other than .exr and .png.
void addPicture(OutputFiles& files, const std::filesystem::path& path, const Picture& picture,
                const std::vector<PictureChannel>& channels);

}  // namespace prelight

#pragma once

#include <filesystem>
#include <vector>

#include "prelight/picture.h"

namespace prelight {

class OutputFiles;

/// Writes a picture as one of several files, base/atomic_file.h. Layers are left out of a .png. Throws
/// UsageError for another extension than .exr and .png.
void addPicture(OutputFiles& files, const std::filesystem::path& path, const Picture& picture,
                const std::vector<PictureChannel>& channels);

}  // namespace prelight

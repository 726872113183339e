#pragma once

#include <filesystem>

#include "io/picture.h"

namespace prelight {

/// Writes R, G, B as 32-bit floats to an .exr file of one part. By OpenEXR itself: what else pictures are
/// read and written with takes longer to load than many a picture takes to draw (images/image_library.h).
/// Throws Error when the file cannot be written.
void writePlainExr(const std::filesystem::path& path, const Picture& picture);

}  // namespace prelight

#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "prelight/picture.h"

namespace prelight {

/// The bytes of an .exr file of one part with R, G, B as 32-bit floats. By OpenEXR itself: what else pictures
/// are read and written with takes longer to load than many a picture takes to draw (images/image_library.h).
/// Throws Error about `shown`.
std::vector<std::byte> encodePlainExr(const std::filesystem::path& shown, const Picture& picture);

}  // namespace prelight

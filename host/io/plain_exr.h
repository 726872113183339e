#pragma once

#include <filesystem>

#include "io/picture.h"

namespace prelight {

/// Writes R, G, B as 32-bit floats to an .exr file of one part, as it is: noisy floats hardly compress, and
/// doing it here loads no library of pictures (images/image_library.h). Throws Error when it cannot be
/// written.
///
/// Industrial Light & Magic, "OpenEXR File Layout" (version 2, scan lines, no compression).
void writePlainExr(const std::filesystem::path& path, const Picture& picture);

}  // namespace prelight

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "images/pixels.h"
#include "prelight/picture.h"

namespace prelight {

/// Encodes an .exr file of one part with R, G, B as 32-bit floats. It uses OpenEXR directly, because the
/// image library takes longer to load than many a picture takes to draw (images/image_library.h). Throws
/// Error about `shown`.
std::vector<std::byte> encodePlainExr(const std::filesystem::path& shown, const Picture& picture);

/// Reads an .exr file of one part in scanlines with only R, G and B. Returns nullopt for other files and for
/// broken, truncated or too large ones. Throws std::bad_alloc.
std::optional<Pixels> readPlainExr(const std::filesystem::path& path);

}  // namespace prelight

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "images/pixels.h"
#include "prelight/picture.h"

namespace prelight {

/// The bytes of an .exr file of one part with R, G, B as 32-bit floats. By OpenEXR itself: what else pictures
/// are read and written with takes longer to load than many a picture takes to draw (images/image_library.h).
/// Throws Error about `shown`.
std::vector<std::byte> encodePlainExr(const std::filesystem::path& shown, const Picture& picture);

/// An .exr file of one part, in rows, of R, G and B alone; nullopt for others, and for those that are broken,
/// cut short or too large. Throws std::bad_alloc.
std::optional<Pixels> readPlainExr(const std::filesystem::path& path);

}  // namespace prelight

#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "prelight/picture.h"

namespace prelight {

/// All channels of all parts of an .exr file.
struct PictureLayers {
  int width = 0;
  int height = 0;
  std::vector<PictureChannel> channels;  ///< named "R", "sh.l1m0.G", ...

  /// Returns the channel of a name, or nullptr if there is none.
  const PictureChannel* find(std::string_view name) const;
};

/// Reads all layers of an .exr file. Throws InputError for a file that is missing, not a regular file, not an
/// .exr, broken, truncated or too large, or whose parts differ in size.
PictureLayers readPictureLayers(const std::filesystem::path& path);

}  // namespace prelight

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
  std::vector<PictureChannel> channels;  ///< "R", "sh.l1m0.G", ...

  /// nullptr when there is none of the name.
  const PictureChannel* find(std::string_view name) const;
};

/// Throws InputError for a file that is missing, no file (a device, a pipe), not an .exr, broken, cut short
/// or too large, or whose parts differ in size.
PictureLayers readPictureLayers(const std::filesystem::path& path);

}  // namespace prelight

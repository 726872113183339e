#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "images/picture_header.h"
#include "prelight/picture.h"

namespace prelight {

/// RGB of an image file as stored (no colour conversion; integers become [0,1]), rows top to bottom.
struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> rgb;  ///< [row][column]; a grey image repeats its channel, alpha is dropped
};

/// Reads EXR, HDR, PNG and JPEG files, distinguished by their first bytes. Uses the channels named R, G and B
/// if there are any, else the first three, else the first one. Throws InputError naming a file that is
/// missing, not a regular file, of another format, broken, truncated or too large.
Pixels readPixels(const std::filesystem::path& path);

/// Returns the format of a picture, which must be one of `formats` and within the limits on size. Throws
/// InputError as readPixels does, before an image library reads the file.
PictureFormat requirePictureFile(const std::filesystem::path& path,
                                 std::initializer_list<PictureFormat> formats);

/// Returns a file name's extension in lower case, with its dot (".exr").
std::string lowerExtension(const std::filesystem::path& path);

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

#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <initializer_list>
#include <string>
#include <vector>

#include "images/picture_header.h"

namespace prelight {

/// RGB of an image file as stored (no colour conversion; integers become [0,1]), rows top to bottom.
struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> rgb;  ///< [row][column]; a grey image repeats its channel, alpha is dropped
};

/// Reads EXR, HDR, PNG and JPEG, told apart by their first bytes. The channels named R, G and B are taken
/// where there are such, else the first three, else the first. Throws InputError naming the file: missing, no
/// file (a device, a pipe), of another format, broken, cut short or too large.
Pixels readPixels(const std::filesystem::path& path);

/// The format of a picture, which must be one of `formats`, and no larger than what is decoded. Throws
/// InputError as readPixels does, before a reader of pictures has seen the file.
PictureFormat requirePictureFile(const std::filesystem::path& path,
                                 std::initializer_list<PictureFormat> formats);

/// A file name's extension in lower case, with its dot (".exr").
std::string lowerExtension(const std::filesystem::path& path);

}  // namespace prelight

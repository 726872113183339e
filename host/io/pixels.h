#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace prelight {

/// RGB of an image file as stored (no colour conversion; integers become [0,1]), rows top to bottom.
struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> rgb;  ///< [row][column]; a grey image repeats its channel, alpha is dropped
};

/// Reads any format of OpenImageIO. The channels named R, G and B are taken where there are such, else the
/// first three, else the first. Throws InputError naming the file: missing, broken, cut short or too large.
Pixels readPixels(const std::filesystem::path& path);

/// A file name's extension in lower case, with its dot (".exr").
std::string lowerExtension(const std::filesystem::path& path);

}  // namespace prelight

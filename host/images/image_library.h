#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "images/picture_header.h"
#include "images/picture_layers.h"
#include "images/pixels.h"
#include "prelight/picture.h"

namespace prelight {

/// All that OpenImageIO does here. Debian's brings some 250 libraries with it, which take 0.2 s to load, so
/// it is linked to a module that is loaded when first asked for: most commands read and write no picture that
/// needs it.
struct ImageLibrary {
  /// See the functions of the same names, which check what they are given.
  Pixels (*readPixels)(const std::filesystem::path& path, PictureFormat format);
  PictureLayers (*readPictureLayers)(const std::filesystem::path& path);
  std::vector<std::uint8_t> (*encodePng)(const Image& image, int channels);

  /// Errors are about `where`.
  Image (*decodeImage)(std::span<const std::uint8_t> bytes, PictureFormat format, const std::string& where);

  /// Bytes of a file: OpenImageIO does not tell of all that goes wrong while it writes one itself. Throws
  /// Error about `shown`. RGB, 8 bits, [row][column].
  std::vector<std::uint8_t> (*encodePicturePng)(const std::filesystem::path& shown, int width, int height,
                                                std::span<const std::uint8_t> rgb);
};

/// Loads the module, if it is not there yet, from where the program's or the library's run path tells. Throws
/// Error naming it when it cannot be found.
const ImageLibrary& imageLibrary();

}  // namespace prelight

/// What the module gives away.
extern "C" const prelight::ImageLibrary* prelightImageLibrary();

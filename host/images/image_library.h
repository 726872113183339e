#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "images/picture_header.h"
#include "images/pixels.h"
#include "prelight/picture.h"

namespace prelight {

/// All functions that use OpenImageIO. Debian's package depends on some 250 libraries, which take 0.2 s to
/// load. It is therefore linked into a module that is loaded at the first use; most commands read and write
/// no picture that needs it.
struct ImageLibrary {
  // Errors of the first three mention `where`.
  Pixels (*decodePixels)(std::span<const std::uint8_t> bytes, PictureFormat format, const std::string& where);
  PictureLayers (*decodeLayers)(std::span<const std::uint8_t> bytes, const std::string& where);
  Image (*decodeImage)(std::span<const std::uint8_t> bytes, PictureFormat format, const std::string& where);

  /// Has OpenImageIO start no threads of its own from now on.
  void (*useOneThread)();

  std::vector<std::uint8_t> (*encodePng)(const Image& image, int channels);

  /// Returns the bytes of a file with 8-bit RGB, [row][column]; OpenImageIO does not report all failures when
  /// it writes a file itself. Throws Error about `shown`.
  std::vector<std::uint8_t> (*encodePicturePng)(const std::filesystem::path& shown, int width, int height,
                                                std::span<const std::uint8_t> rgb);
};

/// Loads the module at the first call, from the run path of the program or the library. Throws Error naming
/// the module when it cannot be found.
const ImageLibrary& imageLibrary();

}  // namespace prelight

/// Entry point of the module.
extern "C" const prelight::ImageLibrary* prelightImageLibrary();

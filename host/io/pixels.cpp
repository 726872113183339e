#include "io/pixels.h"

#include <algorithm>
#include <cctype>

#include "images/image_library.h"
#include "io/special_file.h"

namespace prelight {

Pixels readPixels(const std::filesystem::path& path) {
  refuseSpecialFile(path);
  return imageLibrary().readPixels(path);
}

std::string lowerExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace prelight

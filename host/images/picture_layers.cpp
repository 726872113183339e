#include "images/picture_layers.h"

#include <algorithm>

#include "images/image_library.h"
#include "images/pixels.h"

namespace prelight {

const PictureChannel* PictureLayers::find(std::string_view name) const {
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const PictureChannel& channel) { return channel.name == name; });
  return found == channels.end() ? nullptr : &*found;
}

PictureLayers readPictureLayers(const std::filesystem::path& path) {
  requirePictureFile(path, {PictureFormat::Exr});
  return imageLibrary().readPictureLayers(path);
}

}  // namespace prelight

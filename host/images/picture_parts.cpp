#include "images/picture_parts.h"

#include <array>
#include <string>
#include <utility>

namespace prelight {

std::string_view nameOf(PicturePart part) {
  static constexpr std::array<std::string_view, pictureParts> names = {"emitted", "direct",    "indirect",
                                                                       "caustic", "reflected", "baked"};
  return names[static_cast<std::size_t>(part)];
}

void addLayers(std::span<const PartPicture> parts, std::vector<PictureChannel>& layers) {
  for (const PartPicture& part : parts)
    for (int c = 0; c < 3; ++c) {
      PictureChannel channel{std::string(nameOf(part.part)) + "." + "RGB" [c], {}};
      channel.values.reserve(part.pixels.size());
      for (const glm::vec3& pixel : part.pixels) channel.values.push_back(pixel[c]);
      layers.push_back(std::move(channel));
    }
}

}  // namespace prelight

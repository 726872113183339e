#include "gpu/texture_upload.h"

#include <cmath>

#include "scene/compile/compile_parts.h"
#include "scene/compile/device_wrap.h"

namespace prelight {

std::uint32_t TextureUpload::add(const TextureRef& use, bool srgb) {
  if (use.image < 0) return PRELIGHT_NO_TEXTURE;
  const Image& image = images_[static_cast<std::size_t>(use.image)];
  device::DeviceTexture t{};
  for (int c = 0; c < 3; ++c) {
    t.u[c] = use.transform[c][0];
    t.v[c] = use.transform[c][1];
  }
  t.texelOffset = texelsOf(use.image, srgb);
  t.flags = (use.filter == TextureFilter::Nearest ? PRELIGHT_NEAREST : 0u) |
            (use.texCoord == 1 ? PRELIGHT_SECOND_SET : 0u);
  t.width = static_cast<std::uint32_t>(image.width);
  t.height = static_cast<std::uint32_t>(image.height);
  t.wrapS = deviceWrap(use.wrapS);
  t.wrapT = deviceWrap(use.wrapT);
  textures_.push_back(t);
  return static_cast<std::uint32_t>(textures_.size() - 1);
}

std::uint32_t TextureUpload::texelsOf(int index, bool srgb) {
  const auto [found, isNew] = offsets_.try_emplace({index, srgb}, static_cast<std::uint32_t>(texels_.size()));
  if (!isNew) return found->second;
  const Image& image = images_[static_cast<std::size_t>(index)];
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
    glm::u16vec4 texel(0);
    for (int c = 0; c < 4; ++c) {
      const std::uint8_t byte = image.rgba[i + static_cast<std::size_t>(c)];
      texel[c] = srgb && c < 3 ? static_cast<std::uint16_t>(std::lround(65535.0f * linearFromSrgb(byte)))
                               : static_cast<std::uint16_t>(257 * byte);
    }
    texels_.push_back(texel);
  }
  return found->second;
}

}  // namespace prelight

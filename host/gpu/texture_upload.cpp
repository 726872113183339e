#include "gpu/texture_upload.h"

#include <array>
#include <cmath>

#include "scene/compile/compile_parts.h"
#include "scene/compile/device_wrap.h"

namespace prelight {

namespace {

/// [byte], value in 1/65535.
using SharesOfBytes = std::array<std::uint16_t, 256>;

SharesOfBytes sharesOfBytes(bool srgb) {
  SharesOfBytes shares{};
  for (std::size_t byte = 0; byte < shares.size(); ++byte)
    shares[byte] = static_cast<std::uint16_t>(
        srgb ? std::lround(65535.0f * linearFromSrgb(static_cast<std::uint8_t>(byte)))
             : static_cast<long>(257 * byte));
  return shares;
}

}  // namespace

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
  const std::vector<std::uint8_t>& rgba = images_[static_cast<std::size_t>(index)].rgba;
  const SharesOfBytes alpha = sharesOfBytes(false), colour = sharesOfBytes(srgb);
  texels_.reserve(texels_.size() + rgba.size() / 4);
  for (std::size_t i = 0; i + 3 < rgba.size(); i += 4)
    texels_.emplace_back(colour[rgba[i]], colour[rgba[i + 1]], colour[rgba[i + 2]], alpha[rgba[i + 3]]);
  return found->second;
}

}  // namespace prelight

#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "prelight/scene.h"
#include "shared/scene_types.h"

namespace prelight {

/// Collects textures as kernels read them (kernels/transport/alpha_funcs.cl), one use of an image at a time.
class TextureUpload {
 public:
  /// `images` are accessed until the last add().
  explicit TextureUpload(std::span<const Image> images) : images_(images) {}

  /// Adds a use of an image and returns its index in the textures, or PRELIGHT_NO_TEXTURE for no image.
  /// `srgb` says how its colours are stored. Texels of an image are stored once.
  std::uint32_t add(const TextureRef& use, bool srgb);

  std::vector<device::DeviceTexture> takeTextures() { return std::move(textures_); }
  std::vector<glm::u16vec4> takeTexels() { return std::move(texels_); }  ///< linear, in 1/65535

 private:
  std::uint32_t texelsOf(int image, bool srgb);

  std::span<const Image> images_;
  std::map<std::pair<int, bool>, std::uint32_t> offsets_;
  std::vector<device::DeviceTexture> textures_;
  std::vector<glm::u16vec4> texels_;
};

}  // namespace prelight

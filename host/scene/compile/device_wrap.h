#pragma once

#include <cstdint>

#include "prelight/scene.h"
#include "shared/scene_types.h"

namespace prelight {

/// Returns the value of DeviceTexture::wrapS and wrapT for a texture's mode.
inline std::uint32_t deviceWrap(WrapMode mode) {
  switch (mode) {
    case WrapMode::ClampToEdge:
      return PRELIGHT_WRAP_CLAMP;
    case WrapMode::MirroredRepeat:
      return PRELIGHT_WRAP_MIRROR;
    case WrapMode::Repeat:
      break;
  }
  return PRELIGHT_WRAP_REPEAT;
}

}  // namespace prelight

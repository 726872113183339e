#include "images/plain_png.h"

#include "base/module.h"

namespace prelight {

std::optional<Image> decodePlainPng(std::span<const std::uint8_t> bytes) {
  void* function = moduleFunction("libprelight_png.so", "prelightDecodePlainPng");
  Image image;
  if (!reinterpret_cast<decltype(&prelightDecodePlainPng)>(function)(bytes, image)) return std::nullopt;
  return image;
}

}  // namespace prelight

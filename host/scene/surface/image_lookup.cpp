#include "scene/surface/image_lookup.h"

#include <algorithm>
#include <cmath>

namespace prelight {

namespace {

/// Returns the texel coordinate in [0, size) for any coordinate.
int wrapTexel(double i, int size, WrapMode mode) {
  if (mode == WrapMode::ClampToEdge) return static_cast<int>(std::clamp(i, 0.0, size - 1.0));
  const double period = mode == WrapMode::MirroredRepeat ? 2.0 * size : size;
  const int wrapped = static_cast<int>(i - period * std::floor(i / period));
  return wrapped < size ? wrapped : static_cast<int>(period) - 1 - wrapped;
}

}  // namespace

glm::vec4 sampleImage(const Image& image, const TextureRef& use, const glm::vec2& uv) {
  const bool nearest = use.filter == TextureFilter::Nearest;
  const double middle = nearest ? 0.0 : 0.5;
  const double x = double(uv.x) * image.width - middle, y = double(uv.y) * image.height - middle;
  if (!std::isfinite(x) || !std::isfinite(y)) return glm::vec4(0.0f);
  const double column = std::floor(x), row = std::floor(y);
  const auto texel = [&](double c, double r) {
    const auto at = static_cast<std::size_t>(wrapTexel(r, image.height, use.wrapT)) *
                        static_cast<std::size_t>(image.width) +
                    static_cast<std::size_t>(wrapTexel(c, image.width, use.wrapS));
    const std::uint8_t* rgba = &image.rgba[4 * at];
    return glm::vec4(rgba[0], rgba[1], rgba[2], rgba[3]) / 255.0f;
  };
  if (nearest) return texel(column, row);
  const auto fx = static_cast<float>(x - column), fy = static_cast<float>(y - row);
  const glm::vec4 top = glm::mix(texel(column, row), texel(column + 1.0, row), fx);
  const glm::vec4 bottom = glm::mix(texel(column, row + 1.0), texel(column + 1.0, row + 1.0), fx);
  return glm::mix(top, bottom, fy);
}

}  // namespace prelight

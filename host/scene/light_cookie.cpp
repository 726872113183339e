#include "scene/light_cookie.h"

#include <algorithm>
#include <cmath>

namespace prelight {

namespace {

glm::vec3 usable(const glm::vec3& texel) {
  glm::vec3 result(0.0f);
  for (int c = 0; c < 3; ++c)
    if (std::isfinite(texel[c])) result[c] = std::max(texel[c], 0.0f);
  return result;
}

glm::dvec3 texelAt(const Picture& cookie, int column, int row) {
  const int x = std::clamp(column, 0, cookie.width - 1), y = std::clamp(row, 0, cookie.height - 1);
  return glm::dvec3(cookie.pixels[static_cast<std::size_t>(y) * cookie.width + x]);
}

}  // namespace

Picture cookieOf(const Picture& picture) {
  const int step = (std::max(picture.width, picture.height) + mostCookieSide - 1) / mostCookieSide;
  Picture cookie{(picture.width + step - 1) / step, (picture.height + step - 1) / step, {}};
  for (int row = 0; row < cookie.height; ++row)
    for (int column = 0; column < cookie.width; ++column) {
      glm::vec3 sum(0.0f);
      int count = 0;
      for (int y = row * step; y < std::min((row + 1) * step, picture.height); ++y)
        for (int x = column * step; x < std::min((column + 1) * step, picture.width); ++x, ++count)
          sum += usable(picture.pixels[static_cast<std::size_t>(y) * picture.width + x]);
      cookie.pixels.push_back(sum / static_cast<float>(count));
    }
  return cookie;
}

glm::dvec3 cookieTowards(const Light& light, const glm::dvec3& direction) {
  const Picture& cookie = *light.cookie;
  const double along = glm::dot(direction, light.direction);
  if (!(along > 0.0)) return glm::dvec3(0.0);
  const double widest = along * std::tan(double(light.outerConeAngle));
  const glm::dvec3 up = glm::cross(light.direction, light.side);
  const double u = 0.5 * (1.0 - glm::dot(direction, light.side) / widest) * cookie.width - 0.5;
  const double v = 0.5 * (1.0 - glm::dot(direction, up) / widest) * cookie.height - 0.5;
  const double column = std::floor(std::clamp(u, -1.0, double(cookie.width)));
  const double row = std::floor(std::clamp(v, -1.0, double(cookie.height)));
  const int x = static_cast<int>(column), y = static_cast<int>(row);
  const double right = std::clamp(u - column, 0.0, 1.0), below = std::clamp(v - row, 0.0, 1.0);
  return glm::mix(glm::mix(texelAt(cookie, x, y), texelAt(cookie, x + 1, y), right),
                  glm::mix(texelAt(cookie, x, y + 1), texelAt(cookie, x + 1, y + 1), right), below);
}

glm::dvec3 cookieMean(const Picture& cookie) {
  glm::dvec3 sum(0.0);
  for (const glm::vec3& texel : cookie.pixels) sum += glm::dvec3(texel);
  return sum / static_cast<double>(cookie.pixels.size());
}

}  // namespace prelight

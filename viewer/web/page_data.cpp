#include "viewer/web/page_data.h"

#include <algorithm>
#include <cmath>

#include "compress/small_floats.h"

namespace prelight::viewer {

void PageData::append(const std::string& name, const char* type, std::size_t size,
                      std::span<const std::byte> bytes) {
  arrays_[name] = {{"type", type}, {"offset", bytes_.size()}, {"count", bytes.size() / size}};
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  bytes_.resize((bytes_.size() + 3) / 4 * 4);  // views of arrays begin at multiples of their numbers' size
}

void PageData::addHalves(const std::string& name, std::span<const float> values) {
  std::vector<std::uint16_t> halves(values.size());
  std::transform(values.begin(), values.end(), halves.begin(),
                 [](float v) { return toHalf(std::clamp(v, -halfMax, halfMax)); });
  append(name, "f16", sizeof(std::uint16_t), std::as_bytes(std::span<const std::uint16_t>(halves)));
}

void PageData::addColors(const std::string& name, std::span<const glm::vec3> values) {
  std::vector<std::uint32_t> packed(values.size());
  std::transform(values.begin(), values.end(), packed.begin(), sharedExponent);
  append(name, "e5", sizeof(std::uint32_t), std::as_bytes(std::span<const std::uint32_t>(packed)));
}

/// OpenGL 4.1, 3.8.1.
std::uint32_t sharedExponent(const glm::vec3& color) {
  constexpr int bits = 9, bias = 15, mostExponent = 31;
  constexpr double most = 511.0 / 512.0 * 65536.0;
  const glm::dvec3 c = glm::clamp(glm::dvec3(color), 0.0, most);
  const double largest = std::max({c.r, c.g, c.b});
  int exponent = largest > 0.0 ? std::max(-bias - 1, std::ilogb(largest)) + 1 + bias : 0;
  const auto stepAt = [](int e) { return std::ldexp(1.0, e - bias - bits); };
  if (std::floor(largest / stepAt(exponent) + 0.5) > 511.0) ++exponent;
  exponent = std::min(exponent, mostExponent);
  const glm::dvec3 whole = glm::floor(c / stepAt(exponent) + 0.5);
  return static_cast<std::uint32_t>(whole.r) | static_cast<std::uint32_t>(whole.g) << 9 |
         static_cast<std::uint32_t>(whole.b) << 18 | static_cast<std::uint32_t>(exponent) << 27;
}

std::string toBase64(std::span<const std::byte> bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t length = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < length ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= length ? digits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

}  // namespace prelight::viewer

#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace prelight::viewer {

/// The numbers of a page: arrays one behind the other, little-endian, and what tells them apart.
class PageData {
 public:
  /// Appends values of 4 bytes per number: floats, whole numbers and vectors of either.
  template <typename T>
  void addFloats(const std::string& name, std::span<const T> values) {
    append(name, "f32", sizeof(float), std::as_bytes(values));
  }
  void addWholes(const std::string& name, std::span<const std::uint32_t> values) {
    append(name, "u32", sizeof(std::uint32_t), std::as_bytes(values));
  }
  void addShorts(const std::string& name, std::span<const std::uint16_t> values) {
    append(name, "u16", sizeof(std::uint16_t), std::as_bytes(values));
  }
  /// Halves as they are.
  void addHalfBits(const std::string& name, std::span<const std::uint16_t> bits) {
    append(name, "f16", sizeof(std::uint16_t), std::as_bytes(bits));
  }
  void addBytes(const std::string& name, std::span<const std::uint8_t> values) {
    append(name, "u8", 1, std::as_bytes(values));
  }

  /// Rounded to halves.
  void addHalves(const std::string& name, std::span<const float> values);

  /// Appends radiance or irradiance, >= 0, in 4 bytes (sharedExponent).
  void addColors(const std::string& name, std::span<const glm::vec3> values);

  /// name: {type, offset, count}, bytes and numbers.
  const nlohmann::ordered_json& arrays() const { return arrays_; }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  void append(const std::string& name, const char* type, std::size_t size, std::span<const std::byte> bytes);

  nlohmann::ordered_json arrays_ = nlohmann::ordered_json::object();
  std::vector<std::byte> bytes_;
};

/// A colour in OpenGL's RGB9_E5: 9 bits a channel and an exponent for all. What is below 0 becomes 0.
std::uint32_t sharedExponent(const glm::vec3& color);

/// Digits and + / with padding.
std::string toBase64(std::span<const std::byte> bytes);

}  // namespace prelight::viewer

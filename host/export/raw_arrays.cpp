#include "export/raw_arrays.h"

#include <algorithm>
#include <bit>
#include <iterator>

namespace prelight {

void RawArrays::add(const std::string& name, std::span<const float> values,
                    const std::vector<std::size_t>& shape, const std::string& axes,
                    const std::string& meaning) {
  static_assert(std::endian::native == std::endian::little);
  append(name, "float32", std::as_bytes(values), shape, axes, meaning);
}

void RawArrays::add(const std::string& name, std::span<const std::uint8_t> values,
                    const std::vector<std::size_t>& shape, const std::string& axes,
                    const std::string& meaning) {
  append(name, "uint8", std::as_bytes(values), shape, axes, meaning);
}

void RawArrays::add(const std::string& name, std::span<const std::uint32_t> values,
                    const std::vector<std::size_t>& shape, const std::string& axes,
                    const std::string& meaning) {
  append(name, "uint32", std::as_bytes(values), shape, axes, meaning);
}

void RawArrays::add(const std::string& name, std::span<const std::uint16_t> values,
                    const std::vector<std::size_t>& shape, const std::string& axes,
                    const std::string& meaning) {
  append(name, "uint16", std::as_bytes(values), shape, axes, meaning);
}

void RawArrays::addHalves(const std::string& name, std::span<const std::uint16_t> values,
                          const std::vector<std::size_t>& shape, const std::string& axes,
                          const std::string& meaning) {
  append(name, "float16", std::as_bytes(values), shape, axes, meaning);
}

void RawArrays::append(const std::string& name, const char* type, std::span<const std::byte> bytes,
                       const std::vector<std::size_t>& shape, const std::string& axes,
                       const std::string& meaning) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4, 0);
  json_[name] = {
      {"byteOffset", bytes_.size()}, {"type", type}, {"shape", shape}, {"axes", axes}, {"meaning", meaning}};
  std::transform(bytes.begin(), bytes.end(), std::back_inserter(bytes_),
                 [](std::byte value) { return static_cast<std::uint8_t>(value); });
}

}  // namespace prelight

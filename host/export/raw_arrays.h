#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace prelight {

/// Arrays of numbers, one behind the other in the bytes of a file, and the JSON that says which is where:
/// {name: {byteOffset, type, shape, meaning}}. Little-endian; each begins at a multiple of four bytes.
class RawArrays {
 public:
  /// `shape`: the last of its sizes varies fastest; their product is the number of values. `axes`: what
  /// they are, in the same order.
  void add(const std::string& name, std::span<const float> values, const std::vector<std::size_t>& shape,
           const std::string& axes, const std::string& meaning);
  void add(const std::string& name, std::span<const std::uint8_t> values,
           const std::vector<std::size_t>& shape, const std::string& axes, const std::string& meaning);

  void add(const std::string& name, std::span<const std::uint32_t> values,
           const std::vector<std::size_t>& shape, const std::string& axes, const std::string& meaning);
  void add(const std::string& name, std::span<const std::uint16_t> values,
           const std::vector<std::size_t>& shape, const std::string& axes, const std::string& meaning);
  /// Bits of IEEE halves.
  void addHalves(const std::string& name, std::span<const std::uint16_t> values,
                 const std::vector<std::size_t>& shape, const std::string& axes, const std::string& meaning);

  const std::vector<std::uint8_t>& bytes() const { return bytes_; }
  const nlohmann::ordered_json& json() const { return json_; }

 private:
  void append(const std::string& name, const char* type, std::span<const std::byte> bytes,
              const std::vector<std::size_t>& shape, const std::string& axes, const std::string& meaning);

  std::vector<std::uint8_t> bytes_;
  nlohmann::ordered_json json_ = nlohmann::ordered_json::object();
};

}  // namespace prelight

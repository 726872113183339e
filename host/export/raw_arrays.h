#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"

namespace prelight {

/// Arrays of numbers, one after another in the bytes of a file, and the JSON that describes them: {name:
/// {byteOffset, type, shape, meaning}}. Values are little-endian; each array begins at a multiple of four
/// bytes.
class RawArrays {
 public:
  /// Appends an array. The last size in `shape` varies fastest, and the product of the sizes is the number of
  /// values. `axes` names the sizes in the same order.
  void add(const std::string& name, std::span<const float> values, const std::vector<std::size_t>& shape,
           const std::string& axes, const std::string& meaning);
  void add(const std::string& name, std::span<const std::uint8_t> values,
           const std::vector<std::size_t>& shape, const std::string& axes, const std::string& meaning);

  void add(const std::string& name, std::span<const std::uint32_t> values,
           const std::vector<std::size_t>& shape, const std::string& axes, const std::string& meaning);
  void add(const std::string& name, std::span<const std::uint16_t> values,
           const std::vector<std::size_t>& shape, const std::string& axes, const std::string& meaning);
  /// Appends an array of IEEE halves, given by their bits.
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

/// Add arrays named NAME.* of vertex transfer whose numbers need explanation, and return the further data
/// that a program needs to use them.
nlohmann::ordered_json addRawWavelets(const HaarTransfer& haar, RawArrays& arrays);
nlohmann::ordered_json addRawOccluders(const OccluderTransfer& occluders, RawArrays& arrays);
nlohmann::ordered_json addRawCompressed(const CompressedTransfer& sh, RawArrays& arrays);

/// Adds the per-vertex data of a bake to `arrays`: occlusion, bent normals, irradiance, transfer in SH
/// (compressed or not), in CH and in wavelets, and vector occluders. Returns the further data that a program
/// needs: which vertices belong to which primitive of the file.
nlohmann::ordered_json addRawVertices(const CompiledScene& scene, const Bake& bake, RawArrays& arrays);

}  // namespace prelight

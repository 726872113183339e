#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace prelight {

/// What an attribute's values are asked for as.
struct DracoValues {
  std::uint32_t attribute = 0;      ///< its unique number in the compressed data
  std::uint64_t componentType = 0;  ///< glTF's
  std::size_t components = 0;
};

/// A mesh that was compressed with Draco, decoded.
class DracoMesh {
 public:
  virtual ~DracoMesh() = default;

  virtual std::size_t vertices() const = 0;
  virtual std::size_t triangles() const = 0;
  /// Three vertices for each triangle.
  virtual std::vector<std::uint32_t> indices() const = 0;
  /// [vertex][component] as the file of glTF would store them, without padding. Throws InputError when there
  /// is no such attribute, or its values do not fit.
  virtual std::vector<std::uint8_t> values(const DracoValues& wanted, const std::string& where) const = 0;
};

/// Throws InputError about `where` when the bytes are no triangle mesh of Draco, are broken, or claim so much
/// that decoding it would take more than `mostBytes`, which is found out before memory is taken.
///
/// libdraco is linked to a module that is loaded when first asked for. Debian's has another tinygltf inside,
/// which is not to stand in for ours, and would take every start of the program a millisecond.
std::unique_ptr<DracoMesh> decodeDraco(std::span<const std::uint8_t> bytes, std::uint64_t mostBytes,
                                       const std::string& where);

}  // namespace prelight

/// What the module gives away.
extern "C" void prelightDecodeDraco(std::span<const std::uint8_t> bytes, std::uint64_t mostBytes,
                                    const std::string& where, std::unique_ptr<prelight::DracoMesh>& mesh);

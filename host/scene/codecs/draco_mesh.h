#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace draco {
class Mesh;
}

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
  /// Throws InputError about `where` when the bytes are no triangle mesh of Draco, are broken, or claim so
  /// much that decoding it would take more than `mostBytes`, which is found out before memory is taken.
  DracoMesh(std::span<const std::uint8_t> bytes, std::uint64_t mostBytes, const std::string& where);
  ~DracoMesh();

  std::size_t vertices() const;
  std::size_t triangles() const;
  /// Three vertices for each triangle.
  std::vector<std::uint32_t> indices() const;
  /// [vertex][component] as the file of glTF would store them, without padding. Throws InputError when there
  /// is no such attribute, or its values do not fit.
  std::vector<std::uint8_t> values(const DracoValues& wanted, const std::string& where) const;

 private:
  std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace prelight

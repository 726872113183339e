#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace prelight {

/// A request for the values of an attribute.
struct DracoValues {
  std::uint32_t attribute = 0;      ///< its unique id in the compressed data
  std::uint64_t componentType = 0;  ///< as in glTF
  std::size_t components = 0;
};

/// A decoded mesh that was compressed with Draco.
class DracoMesh {
 public:
  virtual ~DracoMesh() = default;

  virtual std::size_t vertices() const = 0;
  virtual std::size_t triangles() const = 0;
  /// Returns three vertex indices per triangle.
  virtual std::vector<std::uint32_t> indices() const = 0;
  /// Returns values [vertex][component] as a glTF file would store them, without padding. Throws InputError
  /// when there is no such attribute or its values do not fit.
  virtual std::vector<std::uint8_t> values(const DracoValues& wanted, const std::string& where) const = 0;
};

/// Decodes a mesh, by a process without rights (sandbox/decoder.h) where there is one. Throws InputError
/// about `where` when the bytes are no triangle mesh of Draco, are broken, or claim so much that decoding
/// would take more than `mostBytes`, which is checked before memory is allocated.
///
/// libdraco is linked into a module that is loaded on first use. Debian's contains another tinygltf, which
/// must not replace ours, and it would add a millisecond to every start of the program.
std::unique_ptr<DracoMesh> decodeDraco(std::span<const std::uint8_t> bytes, std::uint64_t mostBytes,
                                       const std::string& where);

/// Decodes a mesh in this process, likewise.
std::unique_ptr<DracoMesh> decodeDracoHere(std::span<const std::uint8_t> bytes, std::uint64_t mostBytes,
                                           const std::string& where);

}  // namespace prelight

/// The module's only exported function.
extern "C" void prelightDecodeDraco(std::span<const std::uint8_t> bytes, std::uint64_t mostBytes,
                                    const std::string& where, std::unique_ptr<prelight::DracoMesh>& mesh);

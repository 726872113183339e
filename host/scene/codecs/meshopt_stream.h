#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace prelight {

enum class MeshoptMode : std::uint8_t { Attributes, Triangles, Indices };
enum class MeshoptFilter : std::uint8_t { None, Octahedral, Quaternion, Exponential, Color };

/// What EXT_meshopt_compression and KHR_meshopt_compression say of a compressed buffer view.
struct MeshoptLayout {
  MeshoptMode mode = MeshoptMode::Attributes;
  MeshoptFilter filter = MeshoptFilter::None;
  std::uint64_t count = 0;   ///< of elements: a multiple of 3 for triangles
  std::uint64_t stride = 0;  ///< bytes of one: 2 or 4 of an index, else a multiple of 4 up to 256

  std::uint64_t bytes() const { return count * stride; }
};

/// Bytes that a stream of such elements has at least, whatever they are.
std::uint64_t leastMeshoptBytes(const MeshoptLayout& layout);

/// Decodes a stream to layout.bytes() bytes, filter applied. Throws InputError about `where` when it is
/// broken, or shorter than any that holds so much, which is checked before memory is taken.
std::vector<std::uint8_t> decodeMeshopt(std::span<const std::uint8_t> stream, const MeshoptLayout& layout,
                                        const std::string& where);

}  // namespace prelight

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace prelight {

enum class MeshoptMode : std::uint8_t { Attributes, Triangles, Indices };
enum class MeshoptFilter : std::uint8_t { None, Octahedral, Quaternion, Exponential, Color };

/// A compressed buffer view as EXT_meshopt_compression and KHR_meshopt_compression describe it.
struct MeshoptLayout {
  MeshoptMode mode = MeshoptMode::Attributes;
  MeshoptFilter filter = MeshoptFilter::None;
  std::uint64_t count = 0;   ///< number of elements: a multiple of 3 for triangles
  std::uint64_t stride = 0;  ///< bytes per element: 2 or 4 for indices, otherwise a multiple of 4 up to 256

  std::uint64_t bytes() const { return count * stride; }
};

/// Returns the least number of bytes that a stream of such elements can have.
std::uint64_t leastMeshoptBytes(const MeshoptLayout& layout);

/// Decodes a stream to layout.bytes() bytes with the filter applied. Throws InputError about `where` when it
/// is broken or shorter than any stream of that content, which is checked before memory is allocated.
std::vector<std::uint8_t> decodeMeshopt(std::span<const std::uint8_t> stream, const MeshoptLayout& layout,
                                        const std::string& where);

}  // namespace prelight

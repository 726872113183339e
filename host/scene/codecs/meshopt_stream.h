#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace prelight {

/// Returns the number of elements in a block of attributes of `stride` bytes.
std::size_t attributeBlockElements(std::size_t stride);

/// Returns true when a stream of attributes is of version 1, which KHR_meshopt_compression introduced and
/// which libmeshoptimizer supports from 0.23 on.
bool isVersion1(std::span<const std::uint8_t> stream);

/// Decodes such a stream to all of `out`, elements of `stride` bytes. Returns false when it is broken.
bool decodeVersion1(std::span<const std::uint8_t> stream, std::size_t stride, std::vector<std::uint8_t>& out);

/// Applies the filter COLOR of KHR_meshopt_compression, which libmeshoptimizer supports from 0.24 on: luma
/// and two chroma become red, green and blue. Elements have 4 or 8 bytes.
void decodeColors(std::span<std::uint8_t> data, std::size_t stride);

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

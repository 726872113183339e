#include "scene/codecs/meshopt_stream.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>

#include "prelight/error.h"
#include "scene/codecs/meshopt_attributes.h"
#include "scene/codecs/meshopt_filters.h"

namespace prelight {

namespace {

constexpr const char* exportWithout = "the data are damaged, or export the scene without meshopt compression";

/// Decodes without applying the filter. Returns false when the stream is broken.
bool decodeElements(std::span<const std::uint8_t> stream, const MeshoptLayout& layout,
                    std::vector<std::uint8_t>& out) {
  switch (layout.mode) {
    case MeshoptMode::Triangles:
      return meshopt_decodeIndexBuffer(out.data(), layout.count, layout.stride, stream.data(),
                                       stream.size()) == 0;
    case MeshoptMode::Indices:
      return meshopt_decodeIndexSequence(out.data(), layout.count, layout.stride, stream.data(),
                                         stream.size()) == 0;
    default:
      break;
  }
  if (isVersion1(stream)) return decodeVersion1(stream, layout.stride, out);
  return meshopt_decodeVertexBuffer(out.data(), layout.count, layout.stride, stream.data(), stream.size()) ==
         0;
}

void applyFilter(const MeshoptLayout& layout, std::vector<std::uint8_t>& data) {
  switch (layout.filter) {
    case MeshoptFilter::None:
      return;
    case MeshoptFilter::Octahedral:
      return meshopt_decodeFilterOct(data.data(), layout.count, layout.stride);
    case MeshoptFilter::Quaternion:
      return meshopt_decodeFilterQuat(data.data(), layout.count, layout.stride);
    case MeshoptFilter::Exponential:
      return meshopt_decodeFilterExp(data.data(), layout.count, layout.stride);
    case MeshoptFilter::Color:
      return decodeColors(data, layout.stride);
  }
}

}  // namespace

std::uint64_t leastMeshoptBytes(const MeshoptLayout& layout) {
  constexpr std::uint64_t tableBytes = 16;
  constexpr std::uint64_t sequenceTail = 4;
  switch (layout.mode) {
    case MeshoptMode::Triangles:  // one code per triangle
      return 1 + layout.count / 3 + tableBytes;
    case MeshoptMode::Indices:  // one byte per index
      return 1 + layout.count + sequenceTail;
    default:
      break;
  }
  // For each block two bits per four bytes of an element, as in version 1, and the first element.
  const std::uint64_t blocks = (layout.count - 1) / attributeBlockElements(layout.stride) + 1;
  return 1 + blocks * (layout.stride / 4) + layout.stride;
}

std::vector<std::uint8_t> decodeMeshopt(std::span<const std::uint8_t> stream, const MeshoptLayout& layout,
                                        const std::string& where) {
  const std::uint64_t least = leastMeshoptBytes(layout);
  if (stream.size() < least)
    throw InputError(where,
                     fmt::format("{} elements of {} bytes in {} compressed bytes, they take {} at least",
                                 layout.count, layout.stride, stream.size(), least),
                     exportWithout);
  std::vector<std::uint8_t> data(layout.bytes());
  if (!decodeElements(stream, layout, data))
    throw InputError(where,
                     fmt::format("the meshopt stream cannot be decoded (header byte {:#04x})", stream[0]),
                     exportWithout);
  applyFilter(layout, data);
  return data;
}

}  // namespace prelight

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/gltf/gltf_document.h"

namespace prelight::test {

struct DracoEncoding {
  bool edgebreaker = true;  ///< else the vertices keep their order
  int positionBits = 14;    ///< 0: floats as they are
  int normalBits = 10;
};

/// A copy of an uncompressed document with the data of every primitive in KHR_draco_mesh_compression alone.
/// Only positions, normals and the first texture coordinates are taken.
GltfDocument withDraco(const GltfDocument& document, const DracoEncoding& encoding);

/// A copy with every buffer view that a primitive's accessors show compressed without loss, as `extension`
/// names it: indices as triangles, attributes without a filter. The data that were there are gone.
GltfDocument withMeshopt(const GltfDocument& document,
                         const std::string& extension = "EXT_meshopt_compression",
                         const std::string& indexMode = "TRIANGLES");

/// Puts a compressed stream in the place of a buffer view; `layout` has count, byteStride, mode and filter.
void compressView(GltfDocument& document, std::size_t view, const std::vector<std::uint8_t>& stream,
                  nlohmann::ordered_json layout, const std::string& extension = "EXT_meshopt_compression");

/// Streams of libmeshoptimizer.
std::vector<std::uint8_t> meshoptAttributes(const void* data, std::size_t count, std::size_t stride);
std::vector<std::uint8_t> meshoptTriangles(const std::vector<std::uint32_t>& indices);
std::vector<std::uint8_t> meshoptSequence(const std::vector<std::uint32_t>& indices);

}  // namespace prelight::test

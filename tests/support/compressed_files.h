#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/gltf/gltf_document.h"

namespace prelight::test {

struct DracoEncoding {
  bool edgebreaker = true;  ///< If false, the vertices keep their order.
  int positionBits = 14;    ///< 0 keeps floats.
  int normalBits = 10;
};

/// A copy of an uncompressed document with the data of every primitive in KHR_draco_mesh_compression alone.
/// It keeps positions, normals and the first texture coordinates only.
GltfDocument withDraco(const GltfDocument& document, const DracoEncoding& encoding);

/// A copy in which every buffer view that a primitive's accessors use is compressed losslessly by
/// `extension`: indices as triangles, attributes without a filter. The original data are removed.
GltfDocument withMeshopt(const GltfDocument& document,
                         const std::string& extension = "EXT_meshopt_compression",
                         const std::string& indexMode = "TRIANGLES");

/// Replaces a buffer view by a compressed stream; `layout` has count, byteStride, mode and filter.
void compressView(GltfDocument& document, std::size_t view, const std::vector<std::uint8_t>& stream,
                  nlohmann::ordered_json layout, const std::string& extension = "EXT_meshopt_compression");

/// Streams made by libmeshoptimizer.
std::vector<std::uint8_t> meshoptAttributes(const void* data, std::size_t count, std::size_t stride);
std::vector<std::uint8_t> meshoptTriangles(const std::vector<std::uint32_t>& indices);
std::vector<std::uint8_t> meshoptSequence(const std::vector<std::uint32_t>& indices);

}  // namespace prelight::test

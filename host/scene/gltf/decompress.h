#pragma once

#include <cstdint>
#include <string>

#include "prelight/error.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// The budget for decoding the compressed parts of a document, all together: 2^26 bytes plus 256 per byte of
/// its data, as parts may share their data.
class DecodedBytes {
 public:
  explicit DecodedBytes(std::uint64_t documentBytes);

  std::uint64_t left() const { return left_; }
  /// Takes bytes off the budget before they are allocated. Throws InputError about `where` when too few are
  /// left.
  void take(std::uint64_t bytes, const std::string& where);

 private:
  std::uint64_t left_;
};

/// Decodes the compressed parts of a document (EXT_meshopt_compression, KHR_meshopt_compression,
/// KHR_draco_mesh_compression) once its buffers are embedded: all further code, and every file written from
/// it, handle plain accessors only. Other documents are unchanged. Throws InputError.
void decompress(GltfDocument& document, Warnings& warnings);

}  // namespace prelight

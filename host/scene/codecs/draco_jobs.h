#pragma once

namespace prelight {

/// The library's requests to a process that decodes a mesh, in a session's first byte each.
enum class MeshRequest : char {
  Decode = 'd',   ///< mostBytes (uint64), place for messages, bytes -> vertices, triangles (uint64)
  Indices = 'i',  ///< -> array of uint32
  Values = 'v',   ///< DracoValues, place for messages -> array of bytes
};

}  // namespace prelight

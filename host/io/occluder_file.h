#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "bake/transfer.h"
#include "io/baked_ranges.h"
#include "scene/gltf_document.h"
#include "scene/json_cursor.h"

namespace prelight {

/// Member `vo` of a primitive's entry; its values are appended to the document.
nlohmann::ordered_json occludersToJson(GltfDocument& document, const OccluderTransfer& transfer,
                                       const PrimitiveRanges& ranges);

/// Member `vo` of the root's extension: what occluders are called.
nlohmann::ordered_json occluderNames(const OccluderTransfer& transfer);

/// Puts together the rows of primitives, in whatever order they come.
class OccluderRows {
 public:
  /// `root` is the whole glTF object, `shared` the root's member `vo`, if there is one. Both outlive it.
  OccluderRows(const GltfDocument& document, const JsonCursor& root) : document_(document), root_(root) {}

  /// Reads a primitive's member `vo`. Throws InputError when it does not fit the scene, itself or the others.
  void read(const JsonCursor& json, const PrimitiveRanges& ranges, const std::optional<JsonCursor>& shared);

  /// What was read, for `vertexCount` vertices.
  OccluderTransfer finish(std::size_t vertexCount) const;

 private:
  struct Row {
    std::size_t first = 0;
    std::size_t count = 0;
  };

  const GltfDocument& document_;
  const JsonCursor& root_;
  bool started_ = false;
  OccluderTransfer pool_;  ///< names, what is stored, and records in the order of reading
  std::vector<std::pair<std::size_t, Row>> rows_;  ///< vertex, its records in the pool
};

}  // namespace prelight

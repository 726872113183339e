#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "compress/quantized_occluders.h"
#include "io/values/baked_ranges.h"
#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// Member `vo` of a primitive's entry; its values are appended to the document.
nlohmann::ordered_json occludersToJson(GltfDocument& document, const OccluderTransfer& transfer,
                                       const PrimitiveRanges& ranges);

/// The same of quantized records.
nlohmann::ordered_json occludersToJson(GltfDocument& document, const QuantizedOccluders& occluders,
                                       const PrimitiveRanges& ranges);

/// Member `vo` of the root's extension: what occluders are called.
nlohmann::ordered_json occluderNames(const OccluderTransfer& transfer);

/// The same, and what quantized distances lie between.
nlohmann::ordered_json occluderNames(const QuantizedOccluders& occluders);

/// Puts together the rows of primitives, in whatever order they come.
class OccluderRows {
 public:
  /// `root` is the whole glTF object. All outlive it.
  OccluderRows(const GltfDocument& document, const JsonCursor& root, const CompiledScene& scene)
      : document_(document), root_(root), scene_(scene) {}

  /// Reads a primitive's member `vo`, quantized or not; `shared` is the root's, if there is one. Throws
  /// InputError when it does not fit the scene, itself or the others.
  void read(const JsonCursor& json, const PrimitiveRanges& ranges, const std::optional<JsonCursor>& shared);

  /// What was read, for `vertexCount` vertices.
  OccluderTransfer finish(std::size_t vertexCount) const;

 private:
  struct Row {
    std::size_t first = 0;
    std::size_t count = 0;
  };

  void start(const JsonCursor& json, const std::vector<OccluderVector>& stored,
             const std::optional<JsonCursor>& shared);
  void readVectors(const JsonCursor& json, std::size_t records);
  void readQuantized(const JsonCursor& json, const PrimitiveRanges& ranges,
                     const std::vector<std::uint32_t>& offsets, std::size_t records);

  const GltfDocument& document_;
  const JsonCursor& root_;
  const CompiledScene& scene_;
  double leastDistance_ = 0.0;  ///< of quantized records; 0: the root does not say
  double mostDistance_ = 0.0;
  bool started_ = false;
  OccluderTransfer pool_;  ///< names, what is stored, and records in the order of reading
  std::vector<std::pair<std::size_t, Row>> rows_;  ///< vertex, its records in the pool
};

}  // namespace prelight

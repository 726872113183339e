#pragma once

#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compress/quantized_occluders.h"
#include "io/values/baked_ranges.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// What a baked file is written from. Accessors are appended to the document.
struct BakedOutput {
  GltfDocument& document;
  const CompiledScene& scene;
  const Bake& bake;
  const QuantizedOccluders* occluders;  ///< in place of the bake's; nullptr: none
};

/// What a baked file is read from.
struct BakedInput {
  const GltfDocument& document;
  const JsonCursor& root;  ///< the whole glTF object
  const CompiledScene& scene;
  std::optional<JsonCursor> extension;  ///< the root's PRELIGHT_transfer
};

/// Reads what a file holds of a technique into a bake. Throws InputError for what does not fit the scene,
/// itself or the other primitives.
class TechniqueReader {
 public:
  virtual ~TechniqueReader() = default;

  /// A primitive's entry; primitives come in any order.
  virtual void read(const JsonCursor& /*entry*/, const PrimitiveRanges& /*ranges*/, Bake& /*bake*/) {}

  /// After all primitives.
  virtual void finish(Bake& /*bake*/) {}
};

/// What a bake holds of a technique.
struct BakedSummary {
  std::string key;              ///< in JSON; as the file's extension calls it
  std::string text;             ///< for people, without the size
  std::size_t bytes = 0;        ///< as they are in the file
  bool perVertex = true;        ///< the bytes belong to vertices
  nlohmann::ordered_json json;  ///< for programs
};

/// What baked values depend on besides what hides what: geometry, and where surfaces have holes.
struct SceneUse {
  bool bounces = true;      ///< colours of surfaces, where a bake has bounces
  bool scattering = false;  ///< all that materials are
  bool lights = false;      ///< the scene's own, and colours
};

/// All that Prelight knows of a technique by which light or visibility is baked. A function that is nullptr
/// has nothing to do for it.
struct Technique {
  using Json = nlohmann::ordered_json;

  std::string_view name;                       ///< of its folder
  std::vector<std::string_view> members = {};  ///< of a primitive's entry in a file
  bool everywhere = true;  ///< the members stand on all primitives that have vertices, or on none
  SceneUse use = {};
  std::vector<std::string_view> accessors = {};  ///< members at any depth whose values are accessors

  /// About what writeEntry appends in all.
  std::size_t (*storedBytes)(const Bake&) = nullptr;

  /// Adds its members to a primitive's entry.
  void (*writeEntry)(const BakedOutput&, const PrimitiveRanges&, Json& entry) = nullptr;

  /// Adds what vertices share, and what is not of vertices, to the root's extension.
  void (*writeRoot)(const BakedOutput&, Json& root) = nullptr;

  /// `input` outlives the reader.
  std::unique_ptr<TechniqueReader> (*makeReader)(const BakedInput& input) = nullptr;

  /// What a bake of `vertices` vertices holds of it, if anything.
  void (*summarize)(const Bake&, std::size_t vertices, std::vector<BakedSummary>&) = nullptr;
};

template <class Reader>
std::unique_ptr<TechniqueReader> makeTechniqueReader(const BakedInput& input) {
  return std::make_unique<Reader>(input);
}

}  // namespace prelight

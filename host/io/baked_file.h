#pragma once

#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compress/stored_forms.h"
#include "io/values/quantized_column.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "scene/gltf/gltf_document.h"
#include "techniques/technique.h"

namespace prelight {

/// Reads the data that techniques have stored in a document.
class BakeReader {
 public:
  /// `input` must outlive the object.
  explicit BakeReader(const BakedInput& input);

  /// Reads the PRELIGHT_transfer data for the vertices of the scene. Returns false when no node carries any
  /// and the root has no extension. Throws InputError for data that is inconsistent or does not fit the
  /// scene.
  bool readVertices();

  /// Returns everything that was read, including data that is not per vertex.
  Bake finish();

 private:
  void readEntry(const JsonCursor& entry, const PrimitiveRanges& ranges);

  const BakedInput& input_;
  std::vector<std::string_view> members_;  ///< members that must be present on all primitives or on none
  std::vector<std::unique_ptr<TechniqueReader>> readers_;
  std::optional<std::vector<bool>> there_;  ///< [member], whether the primitives so far have it
  Bake bake_;
};

/// Returns the entry of PRELIGHT_transfer for one primitive: the baked data at its vertices, as accessors
/// that are appended to the document. docs/file-format.md describes every member.
nlohmann::ordered_json entryToJson(const BakedOutput& output, const PrimitiveRanges& ranges);

/// Returns the approximate bytes that entryToJson() appends in total, without compressed and animated data
/// and light maps.
std::size_t storedBytes(const Bake& bake);

/// Adds the techniques' members of the root's extension: names of light groups, times of keys, tables of
/// compression, volumes.
void addRootMembers(const BakedOutput& output, nlohmann::ordered_json& root);

/// Adds the PRELIGHT_transfer extension to a document, replacing an earlier one and its data. Nodes, meshes
/// and materials keep their order; a node with instances stores [instance][vertex]. If given, `forms`
/// replace parts of the bake; returns what columns of bytes save, if it has any. Light maps, which have a
/// separate file, are written by embedLightMap(). Throws Error (RuntimeFailure) for a bake that is not
/// finite.
SavingsByColumn embedBake(GltfDocument& document, const CompiledScene& scene, const Bake& bake,
                          const StoredForms* forms = nullptr);

/// The variant, scene and moment that were baked, as recorded in the file.
struct RecordedChoice {
  std::optional<SceneMoment> moment;  ///< none: at rest
  std::string variant;                ///< empty: the file's own materials
  std::optional<std::size_t> scene;   ///< index in the file; none: not recorded
  std::optional<std::size_t> played;  ///< animation whose moments the file carries
  bool baked = false;                 ///< whether the file has a bake
};

/// Returns the recorded choice, empty for a document without a bake. Throws InputError for a moment of an
/// animation that does not exist.
RecordedChoice readRecordedChoice(const GltfDocument& document);

/// Reads the parts of a bake that a document stores as bytes, without anything else. The document must have
/// been written by embedBake() for the scene.
Bake readQuantizedParts(const GltfDocument& document, const CompiledScene& scene);

/// Reads the PRELIGHT_transfer data of a document; returns nullopt when it has none. Quantised records are
/// decoded, and light maps are read from the files beside the document. Throws InputError when the data does
/// not fit the scene (counts, order, ranges, NaN).
std::optional<Bake> readBake(const GltfDocument& document, const CompiledScene& scene);

}  // namespace prelight

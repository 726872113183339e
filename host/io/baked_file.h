#pragma once

#include <optional>
#include <string>

#include "compress/quantized_occluders.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Adds the PRELIGHT_transfer extension to a document, replacing an earlier one and its data. Nodes, meshes
/// and materials keep their order; a node with instances stores [instance][vertex]. If given, `occluders`
/// replace those of the bake. Light maps, which have a separate file, are written by embedLightMap(). Throws
/// Error (RuntimeFailure) for a bake that is not finite.
void embedBake(GltfDocument& document, const CompiledScene& scene, const Bake& bake,
               const QuantizedOccluders* occluders = nullptr);

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

/// Reads the PRELIGHT_transfer data of a document; returns nullopt when it has none. Quantised records are
/// decoded, and light maps are read from the files beside the document. Throws InputError when the data does
/// not fit the scene (counts, order, ranges, NaN).
std::optional<Bake> readBake(const GltfDocument& document, const CompiledScene& scene);

}  // namespace prelight

#pragma once

#include <optional>
#include <string>

#include "compress/quantized_occluders.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Adds the PRELIGHT_transfer extension to a document, replacing an earlier one and its data.
/// Nodes, meshes and materials keep their order; a node with instances stores [instance][vertex].
/// `occluders`, where given, take the place of the bake's. A light map, of which a file of its own is a part,
/// is embedLightMap's. Throws Error (RuntimeFailure) for a bake that is not finite.
void embedBake(GltfDocument& document, const CompiledScene& scene, const Bake& bake,
               const QuantizedOccluders* occluders = nullptr);

/// What was chosen of a scene that was baked, as its file records it.
struct RecordedChoice {
  std::optional<SceneMoment> moment;  ///< none: it stood at rest
  std::string variant;                ///< empty: its own materials
  std::optional<std::size_t> scene;   ///< of the file's; none: it does not say
  std::optional<std::size_t> played;  ///< the animation that it carries moments of
  bool baked = false;                 ///< whether there is a bake at all
};

/// Nothing of a document without a bake. Throws InputError for a moment of an animation that is not there.
RecordedChoice readRecordedChoice(const GltfDocument& document);

/// Reads the PRELIGHT_transfer data of a document; nullopt when it carries none.
/// Quantized records come back as full ones, and light maps from the files beside the document. Throws
/// InputError when the data does not fit the scene (counts, order, ranges, NaN).
std::optional<Bake> readBake(const GltfDocument& document, const CompiledScene& scene);

}  // namespace prelight

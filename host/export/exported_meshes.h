#pragma once

#include <vector>

#include "export/export_request.h"
#include "export/exported_materials.h"
#include "export/exported_vertices.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Statistics of exporting a document's meshes.
struct ExportedMeshes {
  std::size_t drawings = 0;  ///< instances of meshes with a light map or colours of their own
  std::size_t split = 0;     ///< vertices that were added where charts meet
  std::size_t backs = 0;     ///< primitives that were added for backs
  std::size_t parts = 0;     ///< primitives that were added for charts with separate maps
  float colorScale = 1.0f;   ///< radiance, W/(m2 sr), of a colour of 1 if colours hold light
};

/// Maps in the coordinates of a scene's charts.
struct ChartMaps {
  const LightMapLayout* layout = nullptr;  ///< nullptr: there are no maps
  ChartRanges ranges;                      ///< ranges of charts; each range has a map
  /// [range], textures for materials; empty: materials do not refer to maps.
  std::vector<ChartTexture> textures;
};

/// Gives every instance of a baked mesh a mesh of its own, whose baked data is in standard attributes: the
/// charts' coordinates in the first texture coordinate set that its material leaves free, from TEXCOORD_1 on,
/// or colours. A primitive whose charts lie in several ranges is split into one per range, which share
/// vertices. Instances become nodes. Where both sides of a surface have separate light, the back becomes a
/// primitive that faces the other way.
ExportedMeshes exportMeshes(GltfDocument& document, const Scene& scene, const CompiledScene& compiled,
                            const Bake& bake, const ExportRequest& request, const ChartMaps& maps);

}  // namespace prelight

#pragma once

#include <vector>

#include "export/chart_ranges.h"
#include "export/export_request.h"
#include "export/exported_materials.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// What became of a document's meshes.
struct ExportedMeshes {
  std::size_t drawings = 0;  ///< that have a light map or colours of their own
  std::size_t split = 0;     ///< vertices that were added where charts part
  std::size_t backs = 0;     ///< primitives that were added for the backs of others
  std::size_t parts = 0;     ///< primitives that were added where charts show maps of their own
  float colorScale = 1.0f;   ///< W/(m2 sr) of a colour of 1, where colours hold light
};

/// Maps on a scene's charts.
struct ChartMaps {
  const LightMapLayout* layout = nullptr;  ///< nullptr: there is none
  ChartRanges ranges;                      ///< of charts whose map is the same
  std::vector<ChartTexture> textures;      ///< [range], that materials name; none: they name none
};

/// Gives every drawing of a mesh that was baked a mesh of its own, with what the bake holds of it in standard
/// attributes: the charts' coordinates in the first set that its material leaves free, from TEXCOORD_1 on, or
/// colours. A primitive whose charts are in several ranges becomes one a range, which share their vertices.
/// Instances become nodes. Where both sides of a surface have light of their own, the back is a primitive
/// that faces the other way.
ExportedMeshes exportMeshes(GltfDocument& document, const Scene& scene, const CompiledScene& compiled,
                            const Bake& bake, const ExportRequest& request, const ChartMaps& maps);

}  // namespace prelight

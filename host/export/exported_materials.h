#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "export/export_request.h"
#include "export/exported_animations.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// A texture in the coordinates of the charts.
struct ChartTexture {
  int texture = 0;         ///< index in the document
  double intensity = 1.0;  ///< light maps: irradiance, W/m2, for a texel value of 1
};

/// Differences between a material of the export and the scene's.
struct MaterialUse {
  bool charted = false;   ///< shows a map in the coordinates of the charts
  int map = 0;            ///< index of the map
  int texCoord = 1;       ///< set of the charts' texture coordinates
  bool oneSided = false;  ///< the back has triangles of its own
  bool twoSided = false;  ///< both sides are drawn, whatever the scene's material says
  bool unlit = false;     ///< light is in the vertex colours
  bool glows = false;     ///< base colour and emission are also in the vertex colours

  auto operator<=>(const MaterialUse&) const = default;
};

/// Materials of an exported document: copies of the scene's materials that are used in several ways.
/// MOZ_lightmap shows a light map; since that includes occlusion, the material loses its occlusion texture.
class ExportedMaterials {
 public:
  /// `textures` are the light maps or occlusion maps; if empty, materials do not refer to maps.
  ExportedMaterials(GltfDocument& document, ExportForm form, std::vector<ChartTexture> textures)
      : document_(document), form_(form), textures_(std::move(textures)) {}

  /// Assigns the materials for a use to a primitive and its variants.
  void assign(nlohmann::ordered_json& primitive, const MaterialUse& use);

  /// Call after the last assign(): moves copies into the places of originals that are no longer used, and
  /// returns the other copies.
  std::vector<AnimatedCopies> settle();

 private:
  using Key = std::pair<int, MaterialUse>;  ///< material of the scene, -1: the default one

  int materialFor(int original, const MaterialUse& use);
  nlohmann::ordered_json made(int original, const MaterialUse& use) const;

  GltfDocument& document_;
  ExportForm form_;
  std::vector<ChartTexture> textures_;
  std::map<Key, int> made_;
};

/// Returns whether the material of a primitive depends on the active variant.
bool hasVariants(const nlohmann::ordered_json& primitive);

/// Returns the number of texture coordinate sets that a material's textures use: the greatest index + 1, at
/// least 1.
int texCoordSets(const nlohmann::ordered_json& material);

}  // namespace prelight

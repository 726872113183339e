#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "export/export_request.h"
#include "export/exported_animations.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// A texture on the charts' coordinates.
struct ChartTexture {
  int texture = 0;         ///< of the document
  double intensity = 1.0;  ///< of a light map: W/m2 of a texel of 1
};

/// How a material of the export differs from the scene's.
struct MaterialUse {
  bool charted = false;   ///< it shows a map that lies on charts
  int map = 0;            ///< which one of them
  int texCoord = 1;       ///< set of the charts' coordinates
  bool oneSided = false;  ///< the other side has triangles of its own
  bool twoSided = false;  ///< both sides are drawn, whatever the scene's says
  bool unlit = false;     ///< its light is in the colours of vertices
  bool glows = false;     ///< so are its base colour and its own light

  auto operator<=>(const MaterialUse&) const = default;
};

/// Materials of an exported document: copies of the scene's where they are used in more than one way. A light
/// map is shown by MOZ_lightmap; as it holds what is occluded, the material loses its occlusion texture.
class ExportedMaterials {
 public:
  /// `textures`: of the maps, of light or of occlusion; none: materials do not name them.
  ExportedMaterials(GltfDocument& document, ExportForm form, std::vector<ChartTexture> textures)
      : document_(document), form_(form), textures_(std::move(textures)) {}

  /// Gives a primitive, and its variants, the materials for a use.
  void assign(nlohmann::ordered_json& primitive, const MaterialUse& use);

  /// After the last assign(): copies whose original nothing uses any more take its place. Returns the others.
  std::vector<AnimatedCopies> settle();

 private:
  using Key = std::pair<int, MaterialUse>;  ///< the scene's material, -1: the default one

  int materialFor(int original, const MaterialUse& use);
  nlohmann::ordered_json made(int original, const MaterialUse& use) const;

  GltfDocument& document_;
  ExportForm form_;
  std::vector<ChartTexture> textures_;
  std::map<Key, int> made_;
};

/// Whether materials of a primitive depend on the variant that is shown.
bool hasVariants(const nlohmann::ordered_json& primitive);

/// Sets of texture coordinates that a material's textures use: one more than the largest number, at least 1.
int texCoordSets(const nlohmann::ordered_json& material);

}  // namespace prelight

#pragma once

#include "scene/builtin/gltf_builder.h"

namespace prelight {

/// Indices of the materials of the built-in scene `salon`. SalonTextures holds the sides of their textures.
struct SalonMaterials {
  int parquet, plaster, ceiling, paint;     ///< the room's surfaces; paint: of wood, white
  int walnut, linen, velvet, curtain, rug;  ///< furniture
  int brass, mirror, glass, porcelain, celadon, shade, shadeInside;
  int paving, ashlar, stucco, terracotta, earth, bark;  ///< the court
  int leaves[3];
  int orange, lemon, paper, picture, gilt;
  int books[6];  ///< bindings
};

/// Sides of the square that a texture covers, m.
struct SalonTextures {
  static constexpr double parquet = 1.6, plaster = 1.5, wood = 1.2, fabric = 0.16, paving = 2.4, ashlar = 2.4;
};

SalonMaterials addSalonMaterials(GltfBuilder& builder);

}  // namespace prelight

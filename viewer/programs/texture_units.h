#pragma once

#include <epoxy/gl.h>

namespace prelight::viewer {

/// Texture units of the programs of surfaces.
enum Unit : GLuint {
  baseColorUnit,
  metallicRoughnessUnit,
  emissiveUnit,
  triangleNormalsUnit,
  skyUnit,
  trianglesUnit,        ///< shaders/triangles.glsl
  positionsUnit,        ///< the same
  arrivingUnit,         ///< techniques/glossy/glossy.glsl
  lobesUnit,            ///< the same
  lightMapsUnit,        ///< techniques/light_map/light_map.glsl
  lightMapCornersUnit,  ///< the same
  causticsUnit,         ///< shaders/surface.frag
  shadowMapsUnit,       ///< shadows/shadows.glsl
  shadowViewsUnit,      ///< the same
  surroundingsUnit,     ///< cubes/surroundings.glsl
  insidesUnit,          ///< the same
  reflectionsUnit,      ///< cubes/local_reflections.glsl
  normalTextureUnit,    ///< shaders/normal_map.glsl
  encodedVerticesUnit,  ///< techniques/encoded_light/encoded_light.glsl
  transmissionUnit,
  specularUnit,
  specularColorUnit,
  cornerTangentsUnit,  ///< shaders/normal_map.glsl
  albedosUnit,         ///< shaders/scattering.glsl
  coatUnit,            ///< shaders/top_layers.glsl
  coatRoughnessUnit,   ///< the same
  coatNormalUnit,      ///< the same
  sheenColorUnit,      ///< the same
  sheenRoughnessUnit,  ///< the same
  anisotropyUnit,      ///< shaders/anisotropy.glsl
  filmUnit,            ///< shaders/scattering.glsl
  filmThicknessUnit,   ///< the same
  lampTablesUnit,      ///< shaders/lights.glsl
  screenInputUnit,     ///< shaders/surface.frag, techniques/screen/screen_surface.frag
  screenLampsUnit,     ///< shaders/surface.frag
  screenBounceUnit,    ///< the same
  virtualLightsUnit,   ///< techniques/instant/virtual_lights.glsl
  virtualMapsUnit,     ///< the same
  virtualViewsUnit,    ///< the same
  horizonsUnit,        ///< techniques/horizons/horizons.glsl
  objectLightUnit,     ///< cubes/object_light.glsl
  measuredLobesUnit,   ///< techniques/glossy/glossy.glsl
  skyLobesUnit,        ///< shaders/sky.glsl
  lightMapWallsUnit,   ///< techniques/light_map/light_map.glsl
  unitCount
};

}  // namespace prelight::viewer

#pragma once

#include "charts/make_light_map_layout.h"

namespace prelight::test {

inline LightMapLayout layoutOf(const CompiledScene& scene, double texelSize) {
  LightMapLayoutRequest request;
  request.texelSize = texelSize;
  return makeLightMapLayout(Scene{}, scene, request);
}

inline glm::dvec3 positionOf(const CompiledScene& scene, const LightMapTexel& texel) {
  const auto& t = scene.triangles[texel.face % scene.triangleCount()];
  return (1.0 - double(texel.b1) - double(texel.b2)) * glm::dvec3(scene.positions[t.x]) +
         double(texel.b1) * glm::dvec3(scene.positions[t.y]) +
         double(texel.b2) * glm::dvec3(scene.positions[t.z]);
}

}  // namespace prelight::test

#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "shared/scene_types.h"
#include "shared/shade_types.h"

namespace prelight {

/// Position and normal of every vertex, [vertex][6].
std::vector<float> interleaveVertices(const CompiledScene& scene);

/// Materials for surfaceColor() (kernels/bvh/alpha_funcs.cl) that yield base colours without their textures.
std::vector<device::DeviceMaterial> makeBaseMaterials(const CompiledScene& scene);

/// `textured`: textures multiply the emission; otherwise it is the mean of its own.
std::vector<device::ShadeMaterial> makeShadeMaterials(const CompiledScene& scene, bool textured);

/// Textures, [material][4]: of base colour, of roughness and metalness, of emission, and of the light that
/// comes through, whose factors it holds: the colour times the share as `albedo`, the share as `alphaFactor`.
struct Layers {
  std::vector<device::DeviceMaterial> materials;
  std::vector<glm::u16vec4> texels;  ///< linear, in 1/65535
};
Layers makeLayers(const CompiledScene& scene, const std::vector<Image>& images);

}  // namespace prelight

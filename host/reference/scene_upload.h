#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "reference/reference.h"
#include "shared/reference_types.h"
#include "shared/scene_types.h"

namespace prelight::reference {

/// Position and normal of every vertex, [vertex][6].
std::vector<float> interleaveVertices(const CompiledScene& scene);

/// Materials for surfaceColor() (kernels/bvh/alpha_funcs.cl) that yield base colours without their textures.
std::vector<device::DeviceMaterial> makeBaseMaterials(const CompiledScene& scene);

std::vector<device::ReferenceMaterial> makeReferenceMaterials(const CompiledScene& scene);

/// Textures, [material][3]: of base colour, of roughness and metalness, of emission.
struct Layers {
  std::vector<device::DeviceMaterial> materials;
  std::vector<glm::u16vec4> texels;  ///< linear, in 1/65535
};
Layers makeLayers(const CompiledScene& scene, const std::vector<Image>& images);

/// The camera's part of the parameters.
void setCamera(const Camera& camera, const CompiledScene& scene, int width, int height,
               device::ReferenceParameters& parameters);

}  // namespace prelight::reference

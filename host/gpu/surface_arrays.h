#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "shared/scene_types.h"

namespace prelight {

/// What rays and bounces ask of a scene's materials.
struct SurfaceArrays {
  std::vector<device::DeviceMaterial> materials;
  std::vector<device::DeviceTexture> textures;
  std::vector<glm::u16vec4> texels;  ///< linear RGBA in 1/65535, of all images one after the other
};

/// [material] whether a triangle has it. What the others look up is not uploaded.
std::vector<bool> usedMaterials(const CompiledScene& scene);

SurfaceArrays makeSurfaceArrays(const CompiledScene& scene);

/// DeviceMaterial::flags.
std::uint32_t surfaceFlags(const CompiledMaterial& material);

/// Whether a metalness or transmission that the albedo depends on has a texture: PRELIGHT_ALBEDO_SHARES.
bool albedoHasShares(const CompiledScene& scene);

}  // namespace prelight

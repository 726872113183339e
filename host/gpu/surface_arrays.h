#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "shared/scene_types.h"

namespace prelight {

/// Material data that rays and bounces need.
struct SurfaceArrays {
  std::vector<device::DeviceMaterial> materials;
  std::vector<device::DeviceTexture> textures;
  std::vector<glm::u16vec4> texels;  ///< linear RGBA in 1/65535, all images one after another
};

/// Returns whether any triangle has each material, [material]. Textures of other materials are not uploaded.
std::vector<bool> usedMaterials(const CompiledScene& scene);

SurfaceArrays makeSurfaceArrays(const CompiledScene& scene);

/// Returns the value of DeviceMaterial::flags.
std::uint32_t surfaceFlags(const CompiledMaterial& material);

/// Returns whether a metalness or transmission that the albedo depends on has a texture:
/// PRELIGHT_ALBEDO_SHARES.
bool albedoHasShares(const CompiledScene& scene);

}  // namespace prelight

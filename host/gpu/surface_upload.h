#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "shared/scene_types.h"
#include "shared/shade_types.h"

namespace prelight {

/// Returns position and normal of every vertex, [vertex][6].
std::vector<float> interleaveVertices(const CompiledScene& scene);

/// Returns tangents, [triangle][corner], as kernels/transport/interaction_funcs.cl reads them; empty if no
/// material needs any.
std::vector<std::uint32_t> packTangents(const CompiledScene& scene);

/// Material data of light transport, with textures.
struct ShadeArrays {
  /// Base colours, for surfaceColor() of kernels/transport/alpha_funcs.cl.
  std::vector<device::DeviceMaterial> bases;
  std::vector<device::ShadeMaterial> materials;
  std::vector<device::DeviceTexture> textures;
  std::vector<glm::u16vec4> texels;  ///< linear, in 1/65535
  std::vector<glm::vec4> albedos;    ///< makeAlbedoTable(); empty if nothing reflects with roughness
  std::vector<float> measured;       ///< measured BRDFs, as kernels/transport/measured_funcs.cl reads them
};

/// `images` are Scene::images.
ShadeArrays makeShadeArrays(const CompiledScene& scene, const std::vector<Image>& images);

/// Returns only the material data of panes that shadow rays need, with the textures that the scene keeps for
/// it.
ShadeArrays makePaneArrays(const CompiledScene& scene);

/// Returns material data without textures: only factors count.
ShadeArrays makePlainShadeArrays(const CompiledScene& scene);

}  // namespace prelight

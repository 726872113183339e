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

/// Tangents, [triangle][corner], as kernels/transport/interaction_funcs.cl reads them;
/// none where no material needs any.
std::vector<std::uint32_t> packTangents(const CompiledScene& scene);

/// Materials of what follows light, with their textures.
struct ShadeArrays {
  std::vector<device::DeviceMaterial>
      bases;  ///< surfaceColor() (kernels/transport/alpha_funcs.cl) of them: base colours
  std::vector<device::ShadeMaterial> materials;
  std::vector<device::DeviceTexture> textures;
  std::vector<glm::u16vec4> texels;  ///< linear, in 1/65535
  std::vector<glm::vec4> albedos;    ///< makeAlbedoTable(); none where nothing reflects with roughness
  std::vector<float> measured;       ///< as kernels/transport/measured_funcs.cl reads it
};

/// `images`: Scene::images.
ShadeArrays makeShadeArrays(const CompiledScene& scene, const std::vector<Image>& images);

/// What shadow rays ask of panes alone, with the textures that the scene keeps of these.
ShadeArrays makePaneArrays(const CompiledScene& scene);

/// Without textures: factors count as they are.
ShadeArrays makePlainShadeArrays(const CompiledScene& scene);

}  // namespace prelight

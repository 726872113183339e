#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Returns the reflectance, in linear sRGB, of a thin film over a surface with reflectance `below` along its
/// normal, for light at this cosine: KHR_materials_iridescence's form of Belcour and Barla 2017, clamped to
/// [0,1]. It is the double-precision version, for tables, of kernels/transport/film_funcs.cl. `outside` is
/// the index of refraction above the film; `thickness` is in nm.
glm::dvec3 filmReflectance(double cosine, double outside, double ior, double thickness,
                           const glm::dvec3& below);

/// Returns the thickness of a material's film where its texture is 0 and where it is 1, nm.
glm::vec2 filmThicknesses(const CompiledMaterial& material);

/// Returns the reflectance of a material's dielectric under its film at the first bounce, for its largest
/// channel: x of [thickness][roughness][cosine], then the means over directions [thickness][roughness]
/// (kernels/transport/film_funcs.cl). Textures of the specular colour are ignored.
std::vector<glm::vec4> makeFilmTable(const CompiledMaterial& material);

}  // namespace prelight

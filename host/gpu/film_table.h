#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Reflectance, in linear sRGB, of a thin film over a surface that reflects `below` along its normal, of
/// light from a direction of this cosine: KHR_materials_iridescence's form of Belcour and Barla 2017, bounded
/// by 0 and 1. What kernels/transport/film_funcs.cl computes in floats, in double precision, for tables.
/// `outside`: index of refraction of what lies over the film; `thickness` in nm.
glm::dvec3 filmReflectance(double cosine, double outside, double ior, double thickness,
                           const glm::dvec3& below);

/// Thickness of a material's film where its texture is 0 and 1, nm.
glm::vec2 filmThicknesses(const CompiledMaterial& material);

/// What a material's dielectric reflects under its film at the first bounce, by its largest channel: x of
/// [thickness][roughness][cosine], then their means over directions [thickness][roughness]
/// (kernels/transport/film_funcs.cl). Textures of the specular colour do not count.
std::vector<glm::vec4> makeFilmTable(const CompiledMaterial& material);

}  // namespace prelight

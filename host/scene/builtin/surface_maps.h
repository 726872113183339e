#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>

#include "prelight/picture.h"

namespace prelight {

/// A surface at a point of its texture.
struct SurfacePoint {
  glm::vec3 albedo{0.5f};  ///< linear RGB, 0..1
  float roughness = 1.0f;  ///< 0..1
  float height = 0.0f;     ///< m above the mesh
};

/// Describes a surface over the unit square, which repeats; v runs down the picture.
using SurfacePattern = std::function<SurfacePoint(float u, float v)>;

/// Textures of a glTF material.
struct SurfaceMaps {
  Image albedo;     ///< sRGB
  Image roughness;  ///< linear, in G; B, the metalness, is 255, so that the material's factor counts alone
  Image normals;    ///< in tangent space
};

/// Computes the textures of a pattern at size x size texels; `side` is the square's side in metres, to which
/// heights refer.
SurfaceMaps makeSurfaceMaps(const std::string& name, int size, double side, const SurfacePattern& pattern);

/// Returns a number in [0, 1) that depends on all arguments.
float hashed(int x, int y, std::uint32_t seed);

/// Returns smooth noise in [0, 1] with cellsU x cellsV cells per unit square, over which it repeats.
float tiledNoise(float u, float v, int cellsU, int cellsV, std::uint32_t seed);

/// Returns the sum of octaves of tiledNoise, each of twice as many cells and half the weight, in [0, 1].
float tiledTurbulence(float u, float v, int cellsU, int cellsV, int octaves, std::uint32_t seed);

}  // namespace prelight

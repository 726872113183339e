#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/sh_products.h"
#include "scene/compiled_scene.h"

namespace prelight {

/// A grid of cubic cells, in world space. Values belong to the cells' centres.
struct VolumeGrid {
  glm::ivec3 size{0};  ///< cells along x, y, z
  glm::dvec3 min{0.0};
  glm::dvec3 max{0.0};

  std::size_t count() const {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
           static_cast<std::size_t>(size.z);
  }
  double cell() const { return (max.x - min.x) / size.x; }
};

/// Cells around a scene's bounds: `longest` of them along the longest side, and at least two along each (one
/// when `longest` is 1), so that no flat scene lies in a layer of centres.
VolumeGrid makeVolumeGrid(const CompiledScene& scene, int longest);

/// Transfer of points in the air: the mean over all directions of what arrives, T_i = (1/(4 pi)) integral V
/// Y_i dw, plus light that the surfaces in view reflect. The mean radiance at a point is sum L_i T_i: what a
/// medium that scatters evenly takes in.
struct VolumeTransfer {
  VolumeGrid grid;
  int order = 0;
  int channels = 1;                 ///< 3 with bounces, 1 without
  int bounces = 0;                  ///< diffuse reflections at surfaces
  std::vector<float> coefficients;  ///< [z][y][x][channel][i]
  std::vector<float> direct;        ///< [z][y][x][i], without bounces; empty: `coefficients` are
  std::vector<std::uint8_t> air;    ///< [z][y][x], 0: inside a closed object, where every ray meets a back

  std::size_t columns() const { return static_cast<std::size_t>(order * order); }
};

/// A volume's transfer at a point.
struct VolumeSample {
  int order = 0;
  std::array<std::vector<double>, 3> coefficients;  ///< [channel][i], alike without bounces
  std::vector<double> direct;                       ///< [i]
};

/// Trilinear between the centres of cells, constant beyond them. Cells inside objects are left out, unless
/// nothing else is near: they would darken what is next to the object.
VolumeSample sampleVolume(const VolumeTransfer& volume, const glm::dvec3& position);

/// Mean radiance over all directions, sum L_i T_i. `light` holds [channel][i] for at least the sample's
/// order, `lightColumns` a channel.
glm::dvec3 meanRadiance(const VolumeSample& sample, std::span<const double> light, std::size_t lightColumns);

/// Irradiance over pi of a diffuse point with a unit normal, for objects that move through the volume (their
/// exit radiance is albedo times this). Approximate: what is direct is the product of visibility and light,
/// both cut to the product's orders, under the clamped cosine; what surfaces reflect is taken to arrive
/// evenly from all around. `product` must have the light's order as order() and the sample's as fOrder().
glm::dvec3 diffuseRadiance(const VolumeSample& sample, const sh::ShProduct& product,
                           std::span<const double> light, const glm::dvec3& normal);

}  // namespace prelight

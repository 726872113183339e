#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "prelight/picture.h"
#include "scene/gltf/gltf_document.h"

namespace prelight::test {

/// An object with a single feature, as listed in benchmarks/peers/cycles/grid_cells.json.
struct GridCell {
  std::string name;
  bool isBall = false;  ///< A ball of radius 1, or else a tilted card of 2 x 2 metres.
  /// Whether it reflects all light, so that it shows a uniform sky of 1 as 1.
  bool lossless = false;
  nlohmann::ordered_json material;  ///< glTF material with names of textures in place of indices.
  /// Attributes besides positions, normals and two sets of texture coordinates.
  std::set<std::string> attributes;
};

std::vector<GridCell> readGridCells();

/// The scene of a cell that Cycles rendered (grid_scenes.py): a camera in front of it and, unless `even`, a
/// directional light.
GltfDocument gridScene(const GridCell& cell, bool even);

/// A sky of radiance 1 + w / 2 in direction w, one channel per axis, or 1 everywhere if `even`.
Picture gridSky(bool even);

constexpr double gridYFov = 0.698131700797731810;        // 40 degrees.
constexpr double gridLean[] = {0.17, 0.2, 0.03, 0.964};  // Rotation quaternion of cards, to be normalised.
constexpr double gridEye[] = {0.0, 0.6, 4.0};            // The eye looks at the origin.

}  // namespace prelight::test

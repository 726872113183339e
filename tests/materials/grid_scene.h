#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "prelight/picture.h"
#include "scene/gltf/gltf_document.h"

namespace prelight::test {

/// An object of a single feature, as benchmarks/peers/cycles/grid_cells.json has it.
struct GridCell {
  std::string name;
  bool isBall = false;               ///< of radius 1, else a card of 2 x 2 metres that leans
  bool lossless = false;             ///< returns all light, so that it shows an even sky of 1 as 1
  nlohmann::ordered_json material;   ///< names textures where glTF has their indices
  std::set<std::string> attributes;  ///< beside positions, normals and two sets of texture coordinates
};

std::vector<GridCell> readGridCells();

/// The scene of a cell that Cycles drew (grid_scenes.py): a camera in front of it and, unless `even`, a
/// directional light.
GltfDocument gridScene(const GridCell& cell, bool even);

/// Radiance 1 + w / 2 in direction w, a channel an axis; 1 everywhere if `even`.
Picture gridSky(bool even);

constexpr double gridYFov = 0.698131700797731810;        // 40 degrees
constexpr double gridLean[] = {0.17, 0.2, 0.03, 0.964};  // quaternion of cards, to be normalised
constexpr double gridEye[] = {0.0, 0.6, 4.0};            // looks at the origin

}  // namespace prelight::test

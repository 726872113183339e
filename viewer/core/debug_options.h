#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "prelight/options.h"

namespace prelight::viewer {

/// Views of the data that a picture is computed from, in the order of debugChoices.
enum class DebugView : std::uint8_t {
  None,  ///< the picture itself
  Normals,
  Uv,
  Albedo,
  Wireframe,
  TexelDensity,
  Charts,
  Texels,
  Regions,
  Photons,
  PhotonGroups,
  CausticCells,
  Tree,
  Receivers,
  Probes,
  Approximation,
  Priority,
};

constexpr std::size_t debugViewCount = static_cast<std::size_t>(DebugView::Priority) + 1;

/// The debug view of a picture.
struct DebugOptions {
  static constexpr int deepestTree = 63;

  DebugView shown = DebugView::None;
  int treeDepth = 6;  ///< Tree: level of the boxes, 0 (the root) to deepestTree
  /// Factor that the picture is displayed with. The colours of debug views are divided by it, so that they do
  /// not depend on the light.
  double exposure = 1.0;

  bool operator==(const DebugOptions&) const = default;
};

/// Names and one sentence of each, [DebugView].
inline constexpr std::array<Choice, debugViewCount> debugChoices = {{
    {"none", "the picture itself"},
    {"normals", "shading normals n with their bumps, as the colour (1 + n) / 2"},
    {"uv", "texture coordinates, red along u and green along v, over eighths of a texture"},
    {"albedo", "base colours, unlit"},
    {"wireframe", "edges of triangles"},
    {"texel-density", "texels per metre of the light map, from blue (fewest) to red (most)"},
    {"charts", "charts of the light map, each in a colour"},
    {"texels", "texels of the light map, alternately light and dark in the colour of their chart"},
    {"regions", "regions of the surface over which photons are averaged, each in a colour"},
    {"photons", "photons where they are stored, in the colour of their power"},
    {"photon-groups", "the same, in the colour of the group that is traced again as one"},
    {"caustic-cells", "cells of the picture that hold caustic photons, and those beside them"},
    {"tree", "boxes of the tree that rays pass, at the level --tree-depth"},
    {"receivers", "places that rays of a bake are cast from, with their normals"},
    {"probes", "places of the volume's probes, red inside objects"},
    {"approximation", "irradiance in texels that gathering rays look up, from photon densities"},
    {"priority", "expected change of texels that wait to be gathered again, from blue to red"},
}};

inline const char* nameOf(DebugView view) { return debugChoices[static_cast<std::size_t>(view)].name; }

}  // namespace prelight::viewer

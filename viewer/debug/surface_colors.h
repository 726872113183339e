#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "prelight/light_map.h"
#include "viewer/debug/debug_drawing.h"

namespace prelight::viewer {

/// The sources of the colours of surfaces, as `coloring` of debug_surface.frag.
enum class Coloring : int { Normals, Uv, Albedo, Faces, Texels };

/// Colours of surfaces, unlit.
struct SurfaceColors {
  Coloring coloring = Coloring::Albedo;
  /// Faces: [face], fronts of triangles and then their backs. Texels: [y][x] of `layout`. As displayed at
  /// exposure 1, linear.
  std::vector<glm::vec3> colors = {};
  const LightMapLayout* layout = nullptr;  ///< Texels: where faces lie; only read while the drawing is made
  std::string legend = {};
};

std::unique_ptr<DebugDrawing> drawSurfaceColors(const SurfaceColors& colors, const DebugInputs& of);

}  // namespace prelight::viewer

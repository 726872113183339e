#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "viewer/render_scene.h"
#include "viewer/shading.h"

namespace prelight::viewer {

/// The batches of a picture in the order in which they are drawn.
struct DrawOrder {
  std::vector<const Batch*> opaque;
  std::vector<const Batch*> blended;  ///< over them, the farthest first
};

/// `eye`: scene coordinates. `isFull`: bodies of glass draw what they let through themselves. `leftOutNode`:
/// that is not seen, -1: none.
DrawOrder drawOrderOf(const RenderScene& scene, const glm::dvec3& eye, bool isFull, int leftOutNode);

/// Whether what is opaque draws its depths before its colours, so that nothing hidden is shaded. The depths
/// of a picture cost software OpenGL what about two lights do on its surfaces, and so are worth it where the
/// shading of a pixel costs many times that: in full shading, and where shaders look at many lights.
bool drawsDepthsFirst(Shading shading, std::size_t lights);

}  // namespace prelight::viewer

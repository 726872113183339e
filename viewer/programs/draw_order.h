#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "relight/vertex_lights.h"
#include "viewer/core/shading.h"
#include "viewer/scene/render_scene.h"

namespace prelight::viewer {

/// The batches of a picture in the order in which they are drawn.
struct DrawOrder {
  std::vector<const Batch*> opaque;
  std::vector<const Batch*> blended;  ///< over them, the farthest first
};

/// Triangles that are left out of the cube map around them.
struct LeftOut {
  int node = -1;                           ///< of those that have a cube map; -1: none
  VertexRange object = {};                 ///< whose triangles are not; of none: there is none
  int reflectingNode = -1;                 ///< Batch::reflectingNode of those that are not; -1: none
  std::span<const int> furtherNodes = {};  ///< Batch::node of further ones

  bool has(const Batch& batch) const {
    return (node >= 0 && batch.node == node) ||
           (reflectingNode >= 0 && batch.reflectingNode == reflectingNode) ||
           batch.firstTriangle - object.firstTriangle < object.triangleCount ||
           std::ranges::find(furtherNodes, batch.node) != furtherNodes.end();
  }
};

/// `eye`: scene coordinates. `isFull`: bodies of glass draw what they let through themselves.
DrawOrder drawOrderOf(const RenderScene& scene, const glm::dvec3& eye, bool isFull, const LeftOut& leftOut);

/// Whether what is opaque draws its depths before its colours, so that nothing hidden is shaded. The depths
/// of a picture cost software OpenGL what about two lights do on its surfaces, and so are worth it where the
/// shading of a pixel costs many times that: in full shading, and where shaders look at many lights.
bool drawsDepthsFirst(Shading shading, std::size_t lights);

}  // namespace prelight::viewer

#pragma once

#include <cstddef>
#include <functional>

namespace prelight::viewer {

/// Parts of a frame, in the order in which they are drawn.
enum class FramePass : int {
  Transfer,         ///< what a light becomes through the bake
  ShadowMaps,       ///< of shadings of all light
  VirtualLights,    ///< shadow maps of virtual lights
  EnvironmentMaps,  ///< cube maps of what lies around objects and what reflects or is glass
  Caustics,
  ScreenOcclusion,  ///< of screen shading
  Opaque,           ///< and the sky behind
  Blended,
};

/// A part of a frame that has been drawn.
struct DrawnPass {
  FramePass pass = FramePass::Transfer;
  std::size_t count = 0;   ///< squares of shadow maps or faces of environment maps that were drawn anew
  std::size_t texels = 0;  ///< texels of those squares
};

/// Called when a part's commands have been given to OpenGL. One that waits for OpenGL can tell what the part
/// costs.
using FramePassObserver = std::function<void(const DrawnPass&)>;

}  // namespace prelight::viewer

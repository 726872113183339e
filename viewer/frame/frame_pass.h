#pragma once

#include <functional>

namespace prelight::viewer {

/// Parts of a frame, in the order in which they are drawn.
enum class FramePass : int {
  Transfer,         ///< what a light becomes through the bake
  ShadowMaps,       ///< of full shading
  EnvironmentMaps,  ///< of full shading
  Caustics,
  ScreenOcclusion,  ///< of screen shading
  Opaque,           ///< and the sky behind
  Blended,
};

/// Called when a part's commands have been given to OpenGL. One that waits for OpenGL can tell what the part
/// costs.
using FramePassObserver = std::function<void(FramePass)>;

}  // namespace prelight::viewer

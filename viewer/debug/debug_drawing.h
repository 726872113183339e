#pragma once

#include <memory>
#include <string>

#include "viewer/core/debug_options.h"
#include "viewer/core/render_inputs.h"
#include "viewer/core/view_state.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/programs/batch_drawer.h"
#include "viewer/programs/draw_order.h"
#include "viewer/programs/technique_pass.h"
#include "viewer/scene/render_scene.h"

namespace prelight::viewer {

/// The inputs of what debug views draw; all outlive it.
struct DebugInputs {
  const RenderInputs& inputs;
  const RenderScene& scene;
  BatchDrawer& batches;
  DebugOptions options;
};

/// A tile of a picture that a debug view draws into: it is bound, and the Frame block in use is its own.
struct DebugTile {
  const View& view;
  const Tile& tile;
  const gl::Framebuffer& target;
  const DrawOrder& order;
  SceneDrawer& drawer;

  int samples() const { return target.width() / tile.width; }  ///< of a pixel's side
};

/// A debug view as OpenGL objects.
class DebugDrawing {
 public:
  virtual ~DebugDrawing() = default;

  /// True: it draws the surfaces itself; false: it draws over the shaded picture.
  virtual bool replacesSurfaces() const { return false; }

  virtual void draw(const DebugTile& tile) = 0;

  /// Returns what its colours stand for and how many there are; empty: its name says it.
  virtual std::string legend() const { return {}; }
};

/// The reason why inputs lack the data of a debug view, and what to do about it.
struct DebugLack {
  const char* reason = nullptr;  ///< nullptr: they have the data
  const char* cure = nullptr;
};

/// A debug view in the registry.
struct DebugRow {
  DebugView view;
  DebugLack (*lack)(const RenderInputs& inputs);
  std::unique_ptr<DebugDrawing> (*make)(const DebugInputs& of);
};

}  // namespace prelight::viewer

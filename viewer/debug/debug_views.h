#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "prelight/error.h"
#include "viewer/debug/debug_drawing.h"

namespace prelight::viewer {

/// Returns the debug views that inputs have the data of, in the order of their enumeration; None is the
/// first.
std::vector<DebugView> offeredDebugViews(const RenderInputs& inputs);

/// Throws Error naming what the inputs lack for a debug view.
void requireDebugView(const RenderInputs& inputs, DebugView view);

/// The debug view of a renderer's pictures, whose OpenGL objects are made when it is first shown.
class DebugViews {
 public:
  /// All outlive it.
  DebugViews(const RenderInputs& inputs, const RenderScene& scene, BatchDrawer& batches)
      : inputs_(inputs), scene_(scene), batches_(batches) {}

  /// Returns whether a view's surfaces are drawn by its debug view in place of their shading. Throws as
  /// requireDebugView().
  bool replacesSurfaces(const View& view);

  /// Draws a tile's debug view, if it has one.
  void draw(const DebugTile& tile);

  /// Scene or light of the inputs is another: what was made of it is out of date.
  void changed() { drawing_.reset(); }

  /// Adds the legend of a view's debug view.
  void describe(const View& view, Warnings& notes);

 private:
  DebugDrawing* drawingOf(const View& view);

  const RenderInputs& inputs_;
  const RenderScene& scene_;
  BatchDrawer& batches_;
  std::unique_ptr<DebugDrawing> drawing_;
  DebugOptions madeFor_;
};

}  // namespace prelight::viewer

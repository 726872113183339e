#include "viewer/debug/debug_views.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "viewer/debug/debug_rows.h"

namespace prelight::viewer {
namespace {

const DebugRow* rowOf(DebugView view) {
  for (const std::span<const DebugRow> rows : {geometryRows(), mapRows(), photonRows()})
    for (const DebugRow& row : rows)
      if (row.view == view) return &row;
  return nullptr;
}

}  // namespace

std::vector<DebugView> offeredDebugViews(const RenderInputs& inputs) {
  std::vector<DebugView> views = {DebugView::None};
  for (std::size_t i = 1; i < debugViewCount; ++i) {
    const auto view = static_cast<DebugView>(i);
    if (rowOf(view)->lack(inputs).reason == nullptr) views.push_back(view);
  }
  return views;
}

void requireDebugView(const RenderInputs& inputs, DebugView view) {
  if (view == DebugView::None) return;
  const DebugLack lack = rowOf(view)->lack(inputs);
  if (lack.reason == nullptr) return;
  throw Error(ExitCode::RuntimeFailure, std::string("--debug ") + nameOf(view), lack.reason, lack.cure);
}

DebugDrawing* DebugViews::drawingOf(const View& view) {
  if (view.debug.shown == DebugView::None) return nullptr;
  if (drawing_ != nullptr && madeFor_ == view.debug) return drawing_.get();
  requireDebugView(inputs_, view.debug.shown);
  drawing_ = rowOf(view.debug.shown)->make({inputs_, scene_, batches_, view.debug});
  madeFor_ = view.debug;
  gl::check(std::string("preparing the debug view ") + nameOf(view.debug.shown));
  return drawing_.get();
}

bool DebugViews::replacesSurfaces(const View& view) {
  const DebugDrawing* drawing = drawingOf(view);
  return drawing != nullptr && drawing->replacesSurfaces();
}

void DebugViews::draw(const DebugTile& tile) {
  DebugDrawing* drawing = drawingOf(tile.view);
  if (drawing == nullptr) return;
  drawing->draw(tile);
  gl::check(std::string("drawing the debug view ") + nameOf(tile.view.debug.shown));
}

void DebugViews::describe(const View& view, Warnings& notes) {
  const DebugDrawing* drawing = drawingOf(view);
  if (drawing == nullptr) return;
  if (const std::string legend = drawing->legend(); !legend.empty())
    notes.push_back(std::string(nameOf(view.debug.shown)) + ": " + legend);
}

}  // namespace prelight::viewer

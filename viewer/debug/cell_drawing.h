#pragma once

#include <memory>
#include <vector>

#include "shared/photon_types.h"
#include "viewer/debug/debug_drawing.h"

namespace prelight::viewer {

/// Returns the drawing of the cells of a picture in which caustics are filtered (Larsen 2004, Figure 12.3):
/// orange where photons fall into them, blue where only into a neighbour.
std::unique_ptr<DebugDrawing> drawCells(const std::vector<device::Photon>& caustics, const DebugInputs& of);

}  // namespace prelight::viewer

#pragma once

#include <span>

#include "viewer/debug/debug_drawing.h"

namespace prelight::viewer {

/// Rows of the registry of debug views: of surfaces and of places in the scene, of light maps, and of
/// photons.
std::span<const DebugRow> geometryRows();
std::span<const DebugRow> mapRows();
std::span<const DebugRow> photonRows();

}  // namespace prelight::viewer

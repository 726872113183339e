#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "pictures/session/drawing_session.h"
#include "prelight/device.h"
#include "prelight/picture.h"
#include "shared/photon_types.h"
#include "viewer/core/render_inputs.h"
#include "viewer/frame/render.h"

namespace prelight::pictures {

/// Photons of caustics, for pictures drawn by OpenGL.
struct DrawnCaustics {
  std::vector<device::Photon> photons;
  viewer::Caustics caustics;  ///< refers to `photons`
};

/// Sends `photons` photons from a picture's lights and sky towards everything that makes caustics. Returns
/// null, with a note, if nothing in the scene mirrors or is glass, or if no light reaches such a surface.
std::unique_ptr<DrawnCaustics> traceCaustics(DrawingSession& session, const LoadedScene& loaded,
                                             const viewer::RenderOptions& render, const Environment* sky,
                                             const DeviceOptions& device, std::uint64_t photons);

}  // namespace prelight::pictures

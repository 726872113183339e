#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "pictures/drawing_session.h"
#include "prelight/device.h"
#include "prelight/picture.h"
#include "shared/photon_types.h"
#include "viewer/caustic_pass.h"
#include "viewer/render.h"

namespace prelight::pictures {

/// Photons of caustics for pictures that OpenGL draws.
struct DrawnCaustics {
  std::vector<device::Photon> photons;
  viewer::Caustics caustics;  ///< of `photons`
};

/// Sends `photons` photons towards all that makes caustics, as a picture's lights and sky shine. Null, with a
/// note, where nothing of the scene mirrors or is glass, or no light sees it.
std::unique_ptr<DrawnCaustics> traceCaustics(DrawingSession& session, const OpenedScene& loaded,
                                             const viewer::RenderOptions& render, const Environment* sky,
                                             const DeviceOptions& device, std::uint64_t photons);

}  // namespace prelight::pictures

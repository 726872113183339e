#pragma once

#include "techniques/projector.h"

namespace prelight {

/// Irradiance of the scene's static lights at vertices. nullptr where the request has none.
std::unique_ptr<Projector> radiosityProjector(const BakeContext& context);

}  // namespace prelight

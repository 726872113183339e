#pragma once

#include "techniques/projector.h"

namespace prelight {

/// Ambient occlusion and bent normals. nullptr where the request has none.
std::unique_ptr<Projector> ambientOcclusionProjector(const BakeContext& context);

}  // namespace prelight

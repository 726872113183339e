#pragma once

#include "techniques/projector.h"

namespace prelight {

/// Apertures of the cones about bent normals. nullptr where the request has none. Throws UsageError without
/// ambient occlusion, which they are made of.
std::unique_ptr<Projector> occlusionConesProjector(const BakeContext& context);

}  // namespace prelight

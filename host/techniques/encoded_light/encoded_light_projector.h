#pragma once

#include "techniques/projector.h"

namespace prelight {

/// Stores what arrives at the texels of the bake's light map, and at vertices between which it is nearest to
/// that when it is interpolated, in the encodings that are asked for. The map comes with incidentOrder, and
/// keeps the coefficients that the plan says.
std::unique_ptr<Projector> encodedLightProjector(const BakeContext& context);

}  // namespace prelight

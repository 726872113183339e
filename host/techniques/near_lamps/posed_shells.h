#pragma once

#include <optional>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "prelight/transfer.h"

namespace prelight {

struct SurfaceBend;

/// Returns the shells of near lamps at a moment of an animation, interpolated between the two surrounding
/// keys like transferAt(); nothing if the keys have none.
std::optional<NearLampTransfer> nearLampsAt(const AnimatedTransfer& animated, const Scene& scene,
                                            const CompiledScene& compiled, double seconds);

/// Returns the shells of one pose for a pose that bends the surface (halfTurned).
NearLampTransfer bentNearLamps(const NearLampTransfer& shells, const SurfaceBend& bend);

}  // namespace prelight

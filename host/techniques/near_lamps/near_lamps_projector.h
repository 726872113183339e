#pragma once

#include "techniques/projector.h"

namespace prelight {

/// What shadows lamps within the scene. nullptr where the plan has none.
std::unique_ptr<Projector> nearLampsProjector(const BakeContext& context);

}  // namespace prelight

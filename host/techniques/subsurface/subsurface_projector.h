#pragma once

#include "techniques/projector.h"

namespace prelight {

/// What arrives on the other side of surfaces that let light through. nullptr where the plan leaves it out.
std::unique_ptr<Projector> subsurfaceProjector(const BakeContext& context);

}  // namespace prelight

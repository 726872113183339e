#pragma once

#include "techniques/projector.h"

namespace prelight {

/// Glossy transfer matrices. nullptr where the request has none.
std::unique_ptr<Projector> glossyProjector(const BakeContext& context);

}  // namespace prelight

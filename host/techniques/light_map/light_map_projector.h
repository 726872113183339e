#pragma once

#include "techniques/projector.h"

namespace prelight {

/// Light map of the scene's static lights. nullptr where the request has none.
std::unique_ptr<Projector> lightMapProjector(const BakeContext& context);

}  // namespace prelight

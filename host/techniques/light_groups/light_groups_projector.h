#pragma once

#include "techniques/projector.h"

namespace prelight {

/// Transfer of the scene's own lights. Throws UsageError and InputError as groupLights(); nullptr where the
/// request has none.
std::unique_ptr<Projector> lightGroupsProjector(const BakeContext& context);

}  // namespace prelight

#pragma once

#include "gi/full_light.h"
#include "gi/update/live_light.h"

namespace prelight {

/// What live light shows now, as pictures look it up.
FullLight fullLightOf(const LiveLight& live);

}  // namespace prelight

#pragma once

#include "techniques/projector.h"

namespace prelight {

/// Horizons in sectors of azimuth, from how open those are. nullptr where the request has none.
std::unique_ptr<Projector> horizonsProjector(const BakeContext& context);

}  // namespace prelight

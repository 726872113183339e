#pragma once

#include "techniques/planning.h"

namespace prelight {

/// What comes through surfaces, kept with what other techniques keep of fronts.
Planning subsurfacePlanning();

}  // namespace prelight

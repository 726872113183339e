#pragma once

#include "techniques/planning.h"

namespace prelight {

Planning occlusionConesPlanning();

}  // namespace prelight

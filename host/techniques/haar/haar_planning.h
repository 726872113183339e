#pragma once

#include "techniques/planning.h"

namespace prelight {

Planning haarPlanning();

}  // namespace prelight

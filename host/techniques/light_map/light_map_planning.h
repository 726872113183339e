#pragma once

#include "techniques/planning.h"

namespace prelight {

Planning lightMapPlanning();

}  // namespace prelight

#pragma once

#include "techniques/planning.h"

namespace prelight {

Planning encodedLightPlanning();

}  // namespace prelight

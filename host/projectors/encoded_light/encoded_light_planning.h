#pragma once

#include "projectors/planning.h"

namespace prelight {

Planning encodedLightPlanning();

}  // namespace prelight

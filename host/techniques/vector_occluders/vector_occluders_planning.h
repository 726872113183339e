#pragma once

#include "techniques/planning.h"

namespace prelight {

Planning vectorOccludersPlanning();

}  // namespace prelight

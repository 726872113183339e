#pragma once

#include "projectors/planning.h"

namespace prelight {

Planning vectorOccludersPlanning();

}  // namespace prelight

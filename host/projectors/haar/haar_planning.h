#pragma once

#include "projectors/planning.h"

namespace prelight {

Planning haarPlanning();

}  // namespace prelight

#pragma once

#include "projectors/planning.h"

namespace prelight {

Planning texelsPlanning();

}  // namespace prelight

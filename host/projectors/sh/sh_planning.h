#pragma once

#include "projectors/planning.h"

namespace prelight {

Planning shPlanning();

}  // namespace prelight

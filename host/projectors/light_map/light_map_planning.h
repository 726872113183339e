#pragma once

#include "projectors/planning.h"

namespace prelight {

Planning lightMapPlanning();

}  // namespace prelight

#pragma once

#include "projectors/planning.h"

namespace prelight {

Planning lightGroupsPlanning();

}  // namespace prelight

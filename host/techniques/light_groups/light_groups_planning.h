#pragma once

#include "techniques/planning.h"

namespace prelight {

Planning lightGroupsPlanning();

}  // namespace prelight

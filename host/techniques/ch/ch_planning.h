#pragma once

#include "techniques/planning.h"

namespace prelight {

Planning chPlanning();

}  // namespace prelight

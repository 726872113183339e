#pragma once

#include "techniques/planning.h"

namespace prelight {

Planning glossyPlanning();

}  // namespace prelight

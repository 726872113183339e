#pragma once

#include "techniques/planning.h"

namespace prelight {

Planning shPlanning();

}  // namespace prelight

#pragma once

#include "techniques/planning.h"

namespace prelight {

Planning radiosityPlanning();

}  // namespace prelight

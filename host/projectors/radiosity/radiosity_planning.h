#pragma once

#include "projectors/planning.h"

namespace prelight {

Planning radiosityPlanning();

}  // namespace prelight

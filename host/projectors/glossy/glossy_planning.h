#pragma once

#include "projectors/planning.h"

namespace prelight {

Planning glossyPlanning();

}  // namespace prelight

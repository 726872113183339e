#pragma once

#include "projectors/planning.h"

namespace prelight {

Planning chPlanning();

}  // namespace prelight

#pragma once

#include "projectors/planning.h"

namespace prelight {

Planning occlusionConesPlanning();

}  // namespace prelight

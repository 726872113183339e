#pragma once

#include "projectors/planning.h"

namespace prelight {

Planning ambientOcclusionPlanning();

}  // namespace prelight

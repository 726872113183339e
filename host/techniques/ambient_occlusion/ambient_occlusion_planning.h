#pragma once

#include "techniques/planning.h"

namespace prelight {

Planning ambientOcclusionPlanning();

}  // namespace prelight

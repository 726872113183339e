#pragma once

#include "techniques/planning.h"

namespace prelight {

Planning horizonsPlanning();

}  // namespace prelight

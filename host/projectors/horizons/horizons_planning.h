#pragma once

#include "projectors/planning.h"

namespace prelight {

Planning horizonsPlanning();

}  // namespace prelight

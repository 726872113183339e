#pragma once

#include "techniques/planning.h"

namespace prelight {

Planning volumePlanning();

}  // namespace prelight

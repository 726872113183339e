#pragma once

#include "projectors/planning.h"

namespace prelight {

Planning volumePlanning();

}  // namespace prelight

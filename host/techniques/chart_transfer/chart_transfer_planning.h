#pragma once

#include "techniques/planning.h"

namespace prelight {

Planning chartTransferPlanning();

}  // namespace prelight

#pragma once

#include "projectors/planning.h"

namespace prelight {

Planning chartTransferPlanning();

}  // namespace prelight

#pragma once

#include "projectors/planning.h"

namespace prelight {

Planning nearLampsPlanning();

}  // namespace prelight

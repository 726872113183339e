#pragma once

#include "techniques/planning.h"

namespace prelight {

Planning nearLampsPlanning();

}  // namespace prelight

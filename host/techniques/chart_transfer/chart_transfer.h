#pragma once

#include "techniques/technique.h"

namespace prelight {

/// SH transfer of the texels of charts.
Technique chartTransferTechnique();

}  // namespace prelight

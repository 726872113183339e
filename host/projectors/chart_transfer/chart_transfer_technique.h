#pragma once

#include "projectors/technique.h"

namespace prelight {

/// SH transfer of the texels of charts.
Technique chartTransferTechnique();

}  // namespace prelight

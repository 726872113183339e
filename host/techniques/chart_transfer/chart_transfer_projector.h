#pragma once

#include "techniques/projector.h"

namespace prelight {

/// SH transfer of the texels of charts. Throws UsageError without an order of SH, and for too little memory;
/// nullptr where the request has none.
std::unique_ptr<Projector> chartTransferProjector(const BakeContext& context);

}  // namespace prelight

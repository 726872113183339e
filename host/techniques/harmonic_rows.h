#pragma once

#include "techniques/packed_values.h"
#include "techniques/projector.h"

namespace prelight {

/// SH transfer of the request's order: the first bands of `values`, which are those of a side of `transfer`.
HarmonicTransfer shTransfer(const BakeContext& context, const SlotTransfer& transfer,
                            const SlotValues& values);

/// The same in CH: coefficients, or the inner products that a projection onto non-orthogonal functions takes
/// for them.
HarmonicTransfer chTransfer(const BakeContext& context, const SlotTransfer& transfer,
                            const SlotValues& values);

}  // namespace prelight

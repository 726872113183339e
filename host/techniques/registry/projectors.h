#pragma once

#include <memory>
#include <vector>

#include "techniques/projector.h"

namespace prelight {

/// Projectors of the techniques that a request has, in the order in which they run. Throws what they
/// throw.
std::vector<std::unique_ptr<Projector>> makeProjectors(const BakeContext& context);

}  // namespace prelight

#pragma once

#include <memory>

#include "projectors/technique.h"

namespace prelight {

/// Member `haar` of a primitive's entry.
void writeHaar(const BakedOutput& output, const PrimitiveRanges& ranges, Technique::Json& entry);

std::unique_ptr<TechniqueReader> makeHaarReader(const BakedInput& input);

}  // namespace prelight

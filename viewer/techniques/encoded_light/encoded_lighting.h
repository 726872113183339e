#pragma once

#include <memory>

#include "viewer/programs/drawn_transfer.h"
#include "viewer/programs/technique_pass.h"

namespace prelight::viewer {

/// Draws light in the inputs' encoding in place of what a shading else draws; nullptr where their bake holds
/// none for it.
std::unique_ptr<DrawnTransfer> makeEncoded(Shading shading, const TechniqueInputs& of);

}  // namespace prelight::viewer

#pragma once

#include <memory>
#include <span>

#include "viewer/programs/drawn_shading.h"

namespace prelight::viewer {

/// How a shading is drawn.
const DrawnShading& drawnShadingOf(Shading shading);

/// Whether the inputs hold what a shading needs.
bool offers(const RenderInputs& inputs, Shading shading);

/// Throws Error where the inputs do not hold what a shading needs.
void requireOffered(const RenderInputs& inputs, Shading shading);

/// Throws Error when the bake, or other light of the inputs, does not fit the scene or cannot be drawn.
void checkInputs(const RenderInputs& inputs);

/// Uploads what an offered shading needs; nullptr where it needs nothing.
std::unique_ptr<DrawnTransfer> makeTransfer(Shading shading, const TechniqueInputs& of);

/// The passes of techniques, in the order in which a picture calls them.
std::span<const PassRow* const> passRows();

}  // namespace prelight::viewer

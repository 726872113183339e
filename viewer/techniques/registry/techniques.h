#pragma once

#include <memory>

#include "viewer/core/render_inputs.h"
#include "viewer/core/render_options.h"
#include "viewer/programs/drawing_rules.h"
#include "viewer/programs/drawn_transfer.h"

namespace prelight::viewer {

/// The inputs' encoding is that of light which the bake holds for this shading, so that it draws that.
bool drawsEncoding(Shading shading, const RenderInputs& inputs);

DrawingRules rulesOf(Shading shading, const RenderInputs& inputs);

/// Whether a shading lights objects of the inputs by cube maps: it does where it knows all of the scene's
/// light.
bool lightsByCubes(Shading shading, const RenderInputs& inputs);

/// Drawing rules of objects that cube maps light: as the scene's, but each point is lit from its own
/// position.
DrawingRules rulesOfObjects(DrawingRules scene);

/// Throws Error when something in the bake does not fit the scene or cannot be drawn.
void checkBake(const Bake& bake, const CompiledScene& scene);

/// Throws Error when the light of global illumination does not fit the scene.
void checkGlobalIllumination(const GlobalIllumination& globalIllumination, const CompiledScene& scene);

/// Uploads what the shading needs of a bake that carries it; nullptr where nothing of it is in a bake.
std::unique_ptr<DrawnTransfer> makeDrawnTransfer(Shading shading, const RenderInputs& inputs, Lobe lobe);

}  // namespace prelight::viewer

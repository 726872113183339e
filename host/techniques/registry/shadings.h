#pragma once

#include "techniques/shading.h"

namespace prelight {

/// The shadings of what is baked, each in its technique's folder.
extern const ShadingInfo aoShading, chShading, conesShading, glossyShading, haarShading, horizonsShading,
    lightMapShading, lightsShading, occluderShading, radiosityShading, shShading;

/// Throws Error when something in the bake does not fit the scene or cannot be drawn.
void checkBake(const Bake& bake, const CompiledScene& scene);

/// Moves what a bake holds for pictures into another bake.
void takeBake(Bake& into, Bake&& from);

/// Asks for what comes with the transfer that a request has, as `asked` does.
void addParts(BakeRequest& request, const BakeRequest& asked);

}  // namespace prelight

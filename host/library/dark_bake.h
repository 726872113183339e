#pragma once

#include <string>

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/picture.h"
#include "prelight/scene.h"

namespace prelight {

/// Returns warnings about probable mistakes in the baked light of a scene's own lamps: a part that is
/// entirely black, with the reasons, or else lamps that are enclosed by surfaces. Returns none for bakes
/// without such light. `sky` is the one that was baked with; may be nullptr.
Warnings warningsOfDarkness(const Scene& scene, const CompiledScene& compiled, const Bake& bake,
                            const Environment* sky);

}  // namespace prelight

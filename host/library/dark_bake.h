#pragma once

#include <string>

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/picture.h"
#include "prelight/scene.h"

namespace prelight {

/// What is likely not meant about the light of a scene's own lamps that a bake holds: a part that is black
/// all over, with the reasons, or else lamps that something shuts in. Empty where it holds no such light.
/// `sky`: that it was baked with; may be nullptr.
Warnings warningsOfDarkness(const Scene& scene, const CompiledScene& compiled, const Bake& bake,
                            const Environment* sky);

}  // namespace prelight

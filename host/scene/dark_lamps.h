#pragma once

#include <span>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/picture.h"

namespace prelight {

/// Returns why nothing in a scene is lit: one sentence per lamp, emissive surface or sky whose light arrives
/// nowhere, as far as its position, its strength and its surroundings tell, and at most `most` sentences.
/// `sky` may be nullptr. A light without a known reason is said to light nothing.
std::vector<std::string> reasonsForDarkness(const CompiledScene& scene, std::span<const Light> lights,
                                            const Environment* sky, std::size_t most = 5);

/// Returns the warning, with the reasons, for a result that should hold light and is entirely black; `what`
/// is its subject ("the light map").
std::string darknessWarning(const std::string& what, const CompiledScene& scene,
                            std::span<const Light> lights, const Environment* sky);

}  // namespace prelight

#pragma once

#include <span>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/picture.h"

namespace prelight {

/// Why nothing in a scene is lit: a sentence for each lamp, emissive surface or sky whose light arrives
/// nowhere, as far as its place, its strength and what is around it tell; of at most `most`. `sky` may be
/// nullptr. One that nothing is found about is said to light nothing, without a reason.
std::vector<std::string> reasonsForDarkness(const CompiledScene& scene, std::span<const Light> lights,
                                            const Environment* sky, std::size_t most = 5);

/// The warning of a result that holds light and is black all over; `what` is its subject ("the light map").
/// It tells the reasons.
std::string darknessWarning(const std::string& what, const CompiledScene& scene,
                            std::span<const Light> lights, const Environment* sky);

}  // namespace prelight

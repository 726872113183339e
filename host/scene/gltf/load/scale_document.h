#pragma once

#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Enlarges all scenes of a checked document by `scale` around the world's origin: each root node gets a
/// parent that scales it, behind the existing nodes. Lengths that a node's scale does not affect (ranges of
/// lights, planes and magnifications of cameras, attenuation distances) are multiplied; intensities are
/// unchanged. Animated lengths of materials, lights and cameras (KHR_animation_pointer) are unchanged, too.
/// `scale` > 0.
void scaleDocument(GltfDocument& document, double scale);

}  // namespace prelight

#pragma once

#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Makes all scenes of a checked document `scale` times as large about the world's origin: each root node
/// gets a parent that scales it, behind the nodes that there are. Lengths that node scale does not reach
/// (ranges of lights, planes and magnifications of cameras, attenuation distances) are multiplied;
/// intensities stay. Animated lengths of materials, lights and cameras (KHR_animation_pointer) stay too.
/// `scale` > 0.
void scaleDocument(GltfDocument& document, double scale);

}  // namespace prelight

#pragma once

#include "prelight/error.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Resolves scenes that list nodes which are children of others, as some exporters write them, in a checked
/// document: a node with an ancestor in the same scene's list is drawn there and removed from the list; a
/// node whose parent no scene draws is removed from that parent. Warns of each. A child that must remain
/// both, because another scene draws it below its parent, is an InputError.
void settleListedChildren(GltfDocument& document, Warnings& warnings);

}  // namespace prelight

#pragma once

#include "prelight/error.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Scenes that list nodes which are children of others, as some exporters write them, in a checked document:
/// a node whose ancestor the scene lists too is drawn there and leaves the list; one whose parent no scene
/// draws leaves that parent. Warns of each. A child that stays both, drawn by another scene below its parent,
/// is an InputError.
void settleListedChildren(GltfDocument& document, Warnings& warnings);

}  // namespace prelight

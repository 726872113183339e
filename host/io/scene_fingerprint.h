#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/state_file.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Vertices, and triangles with the materials that they have.
void addGeometry(const CompiledScene& scene, StateHash& hash);

/// What all bakes read of materials.
void addMaterials(const CompiledScene& scene, StateHash& hash);

/// By which a baked file tells later that its scene has been changed: {geometry, materials}.
nlohmann::ordered_json fingerprintOf(const CompiledScene& scene);

/// What has changed of a scene since it was baked: "geometry", "materials" or both. None where nothing has,
/// where the file does not say (earlier versions wrote no fingerprint), and where the scene is posed
/// otherwise on purpose.
std::optional<std::string> changedSinceBake(const GltfDocument& document, const Scene& scene,
                                            const CompiledScene& compiled);

}  // namespace prelight

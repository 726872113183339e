#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/state_file.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Vertices, and triangles with the materials that they have.
void addGeometry(const CompiledScene& scene, StateHash& hash);

/// What all bakes read of materials.
void addMaterials(const CompiledScene& scene, StateHash& hash);

/// What baked values depend on besides geometry and the holes of surfaces.
struct BakeSubject {
  bool colors = false;      ///< of surfaces
  bool scattering = false;  ///< all that materials are
  bool lights = false;      ///< the scene's own
};

/// Of all that a bake holds.
BakeSubject subjectOf(const Bake& bake, std::size_t vertices);

/// By which a baked file tells later that its scene has been changed (docs/file-format.md): hashes of what
/// the baked values depend on.
nlohmann::ordered_json fingerprintOf(const GltfDocument& document, const CompiledScene& scene,
                                     const BakeSubject& subject);

/// How a scene differs from what was baked.
struct StaleScene {
  std::vector<std::string> parts;       ///< of "geometry", "materials", "textures" and "lights"
  std::vector<std::string> stale = {};  ///< techniques whose values do not fit it any more
  bool all = false;                     ///< they are all that the file carries
};

/// A baked scene as it is now.
struct BakedScene {
  const GltfDocument& document;
  const Scene& scene;
  const CompiledScene& compiled;
  const Bake& bake;
};

/// What has changed of a scene since it was baked, as far as it matters to what is `used` of the bake. None
/// where nothing has, where the file does not say (earlier versions wrote no fingerprint, or less of one),
/// and where the scene is posed otherwise on purpose.
std::optional<StaleScene> changedSinceBake(const BakedScene& baked, BakeSubject used);

/// The same for all that the bake holds.
std::optional<StaleScene> changedSinceBake(const BakedScene& baked);

/// "the scene's lights changed after it was baked: what it carries does not fit it".
std::string textOf(const StaleScene& change);

}  // namespace prelight

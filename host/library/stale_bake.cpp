#include "prelight/stale_bake.h"

#include "io/scene_fingerprint.h"

namespace prelight {

std::optional<std::string> staleBake(const LoadedScene& scene, const Bake& carried) {
  const auto change = changedSinceBake({*scene.document, scene.scene, scene.compiled, carried});
  return change ? std::optional(textOf(*change)) : std::nullopt;
}

}  // namespace prelight

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// A primitive with a triangle so large that values at vertices cannot show the shadows on it.
struct CoarsePrimitive {
  std::uint32_t primitive = 0;  ///< index into CompiledScene::primitives
  double edge = 0.0;            ///< m, longest edge of its largest triangle
  double share = 0.0;           ///< that triangle's share of the scene's surface
};

/// Finds triangles of more than a hundredth of the scene's surface that have a vertex in front of them, no
/// farther away than they are long. Returns the primitives with such triangles, the one with the largest
/// first. Nothing is cast.
std::vector<CoarsePrimitive> findCoarsePrimitives(const CompiledScene& scene);

/// Returns a warning that names the worst of them, or nothing if there is none.
std::optional<std::string> coarseWarning(const std::filesystem::path& path, const CompiledScene& scene);

}  // namespace prelight

#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/compiled_scene.h"
#include "scene/scene.h"

namespace prelight {

/// What the user asked a bake for.
struct BakeRequest {
  bool ao = false;                ///< ambient occlusion and bent normal
  int shOrder = 0;                ///< 0: none; 1..8
  int bounces = 0;                ///< diffuse interreflections in the SH transfer, 0..16
  std::uint64_t rays = 1024;      ///< rays a vertex, on average; ignored with error or seconds
  std::optional<double> error;    ///< stop when AO's estimated standard error is below this at every vertex
  std::optional<double> seconds;  ///< stop after this time
  std::uint64_t seed = 0;
  std::uint64_t maxMemory = std::uint64_t{2} << 30;  ///< bytes that the bake's own buffers may take

  static constexpr int maxShOrder = 8;
  static constexpr int maxBounces = 16;
  static constexpr std::uint64_t maxRays = 1u << 20;
};

/// One pass of a bake and why it runs or is skipped.
struct PlannedPass {
  std::string name;
  bool runs = false;
  std::string reason;
};

/// Which passes a bake needs, from the scene and the request, and the memory that they take.
struct Plan {
  std::vector<PlannedPass> passes;
  std::uint64_t hostBytes = 0;
  std::uint64_t deviceBytes = 0;
  std::uint64_t transportBytes = 0;  ///< part of the above: stored hits that feed the bounces

  bool runs(const std::string& pass) const;
  nlohmann::ordered_json toJson() const;
};

/// Decides what a bake does. Never throws; a scene without triangles gives a plan that runs nothing.
Plan makePlan(const Scene& scene, const CompiledScene& compiled, const BakeRequest& request);

}  // namespace prelight

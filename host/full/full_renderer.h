#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/progress.h"
#include "gather/indirect_light.h"
#include "io/picture.h"
#include "plan/plan.h"
#include "scene/scene.h"

namespace prelight {

/// A picture with all light: direct light and mirrors traced at every pixel, indirect light gathered
/// beforehand, caustics from photons.
struct FullRequest {
  int width = 0;
  int height = 0;
  std::uint32_t samples = 8;        ///< a pixel, 1 to 64
  std::uint32_t texels = 1u << 13;  ///< of the light map that holds indirect light, about
  IndirectRequest indirect;
  std::uint64_t causticPhotons = 100000;  ///< that leave lights towards what makes caustics
  int depth = 16;                         ///< mirrors and glass before a camera's path ends
  std::uint64_t seed = 0;
};

struct FullReport {
  std::vector<PlannedPass> plan;
  std::vector<std::pair<std::string, double>> stageSeconds;
  std::uint64_t rays = 0;
  PhotonReport photons;
  PhotonReport causticPhotons;
  std::size_t texels = 0;
};

/// Throws UsageError when the light map would be too large, Interrupted between blocks.
Picture renderFull(const Scene& scene, const LitScene& lit, const Camera& camera, const FullRequest& request,
                   const Device& device, Progress& progress, FullReport& report);

}  // namespace prelight

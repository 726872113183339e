#pragma once

#include <optional>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/plan.h"
#include "techniques/light_map/light_map_light.h"
#include "techniques/light_map/light_map_parts.h"

namespace prelight {

/// Every share of the light in a light map that the plan runs.
class LightMapSources {
 public:
  /// Sends photons, where some are needed, for a map of this layout (see LightMapLight). `coefficients`: see
  /// LightMap. Everything outlives it.
  LightMapSources(const Scene& source, const CompiledScene& scene, const LightMapLayout& layout,
                  const BakeRequest& request, const Plan& plan, int coefficients, const Device& device,
                  Tracer& tracer, Progress& progress);

  std::span<LightMapPart* const> parts() const { return parts_; }

  /// Irradiance at places of the surface, W/m2, [place][channel]. `hidden` as
  /// LightMapPart's. Throws Interrupted between blocks, which are kept.
  std::vector<float> irradiance(std::span<const LightMapTexel> places, std::vector<std::uint8_t>& hidden,
                                const Progress& progress);

  std::uint64_t rays() const;  ///< of all parts so far

 private:
  void addDirect(const CompiledScene& scene, const BakeRequest& request, Tracer& tracer);

  int coefficients_;
  std::uint64_t earlierRays_ = 0;  ///< of runs that are gone on with
  std::optional<LightMapLight> light_;
  std::optional<EmitterLightPart> emitters_;
  std::optional<InsidePart> inside_;
  std::optional<PointLightPart> points_;
  std::optional<SkyLightPart> sky_;
  std::vector<LightMapPart*> parts_;
};

}  // namespace prelight

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "photon/caustic_light.h"
#include "prelight/compiled_scene.h"
#include "prelight/plan.h"
#include "techniques/light_map/light_map_parts.h"

namespace prelight {

/// The parts of a light map that photons bring: indirect light and caustics, as far as the plan runs them.
class LightMapLight {
 public:
  /// Sends the photons. Everything outlives it; the light is the scene's own and
  /// the request's sky.
  LightMapLight(const Scene& source, const CompiledScene& scene, const LightMapLayout& layout,
                const BakeRequest& request, const Plan& plan, const Device& device, Tracer& tracer,
                Progress& progress);

  void addTo(std::vector<LightMapPart*>& parts);

 private:
  void traceCaustics(const CompiledScene& scene, const LightMapLayout& layout, const BakeRequest& request,
                     const Device& device, Progress& progress);

  LitScene lit_;
  TransportScene transport_;
  DensitySurface surface_;
  SurfacePatches patches_;
  std::optional<SurfacePatches> withBacks_;  ///< what gathering rays look up where photons met backs
  std::optional<IndirectLight> indirect_;
  std::unique_ptr<CausticLight> causticLight_;
  std::optional<IndirectLightPart> indirectPart_;
  std::optional<PhotonLightPart> causticPart_;
};

/// As many times the photons where a filter follows: what they tell wrongly all gathering rays see, so that
/// no filter knows it for noise.
constexpr std::uint64_t photonsForFilters = 4;

}  // namespace prelight

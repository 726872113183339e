#pragma once

#include "viewer/shadows/shadowed_lighting.h"
#include "viewer/techniques/instant/virtual_light_maps.h"

namespace prelight::viewer {

/// Instant radiosity (Keller 1997): lights with the shadows of their maps, and indirect light of virtual
/// lights with theirs, of which those grow old that nothing has changed but what they see (Laine et al.
/// 2007).
class InstantRadiosityLighting final : public ShadowedLighting {
 public:
  /// Everything but the set outlives it.
  InstantRadiosityLighting(const VirtualLightSet& set, const CompiledScene& compiled,
                           const RenderScene& scene);

  void light(const Illumination& light) override;
  void bind(const gl::Program& program) const override;
  void sceneMoved() override;
  bool isBehind() const override;

  /// From now on these lights shine.
  void updateLights(const VirtualLightSet& set);

  /// False: a light() draws all maps of virtual lights that show what was there before.
  void paceUpdates(bool pace) { paced_ = pace; }

  const VirtualLightMaps& virtualLights() const { return maps_; }

 private:
  VirtualLightMaps maps_;
  std::size_t renewals_ = 0;
  bool paced_ = false;
};

}  // namespace prelight::viewer

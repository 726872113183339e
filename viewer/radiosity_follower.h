#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "radiosity/live_radiosity.h"
#include "viewer/light_follower.h"

namespace prelight::viewer {

/// Live radiosity as a window's light: lamps that are dragged, added and changed, and a sky that is turned.
/// What stands in the light's way is taken to stay where it was.
class RadiosityFollower final : public LightFollower {
 public:
  /// `shown`: the lights of the irradiance that the window opens with. `live` and the sky outlive it.
  RadiosityFollower(LiveRadiosity& live, RadiosityLights shown);

  Shading shading() const override { return Shading::Radiosity; }
  bool update(const FollowedView& view) override;
  bool settled() const override { return !live_.isBusy(); }
  void show(Renderer& renderer) const override;

  /// W/m2, [vertex]; empty before the first light has changed.
  std::span<const glm::vec3> irradiance() const { return irradiance_; }

 private:
  bool differs(const FollowedView& view) const;

  LiveRadiosity& live_;
  RadiosityLights told_;
  std::vector<glm::vec3> irradiance_;
};

}  // namespace prelight::viewer

#pragma once

#include "integrators/live_virtual_lights.h"
#include "viewer/follow/light_follower.h"

namespace prelight::viewer {

/// Virtual lights of a window's instant shading: a few of those that what is dragged and turned concerns are
/// made anew a frame.
class VirtualLightFollower final : public LightFollower {
 public:
  /// `live` outlives it.
  explicit VirtualLightFollower(LiveVirtualLights& live) : live_(live) {}

  Shading shading() const override { return Shading::Instant; }
  bool update(const FollowedView& view) override;
  bool settled() const override { return live_.settled(); }
  void show(Renderer& renderer) const override;

 private:
  LiveVirtualLights& live_;
};

}  // namespace prelight::viewer

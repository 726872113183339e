#pragma once

#include <vector>

#include "gi/global_illumination.h"
#include "gi/update/live_light.h"
#include "viewer/light_follower.h"

namespace prelight::viewer {

/// Live light as a window's light: what is dragged and turned there is told to it, a frame at a time.
class LiveFollower final : public LightFollower {
 public:
  /// `start`: illuminationOf(live), whose filter of caustics stays. Both outlive it.
  LiveFollower(LiveLight& live, const GlobalIllumination& start);

  bool update(const FollowedView& view) override;
  bool settled() const override { return live_.settled(); }
  std::span<const float> indirect() const override { return map_.values; }
  Caustics caustics() const override { return {photons_, filter_}; }

  /// What the last update did.
  const LiveFrame& frame() const { return frame_; }

 private:
  void tell(const FollowedView& view);

  LiveLight& live_;
  LightMap map_;
  std::vector<device::Photon> photons_;
  CausticFilter filter_;
  std::vector<NodeShift> shifts_;  ///< that live light knows of
  LiveFrame frame_;
};

}  // namespace prelight::viewer

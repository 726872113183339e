#pragma once

#include <vector>

#include "gi/global_illumination.h"
#include "gi/update/live_light.h"
#include "viewer/follow/light_follower.h"
#include "viewer/core/render_inputs.h"

namespace prelight::viewer {

/// Live light as a window's indirect light and caustics of full shading: what is dragged, turned and played
/// there is told to it, a frame at a time. Once all has settled, caustics are filtered as those of a window
/// that opens then.
class LiveFollower final : public LightFollower {
 public:
  /// `start`: illuminationOf(live). Both outlive it.
  LiveFollower(LiveLight& live, const GlobalIllumination& start);

  Shading shading() const override { return Shading::GlobalIllumination; }
  bool update(const FollowedView& view) override;
  bool settled() const override { return live_.settled(); }
  void show(Renderer& renderer) const override;

  /// W/m2, [y][x][channel 3] of the light map that the window was opened with.
  std::span<const float> indirect() const { return map_.values; }

  /// The photons stay until the next update().
  Caustics caustics() const { return {photons_, filter_}; }

  /// Counts and times of the last update.
  const LiveFrame& frame() const { return frame_; }

 private:
  LiveLight& live_;
  LightMap map_;
  std::vector<device::Photon> photons_;
  CausticFilter filter_;
  bool filterIsOld_ = false;  ///< of other photons
  LiveFrame frame_;
};

}  // namespace prelight::viewer

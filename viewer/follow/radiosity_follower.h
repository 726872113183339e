#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "radiosity/live_radiosity.h"
#include "viewer/follow/light_follower.h"

namespace prelight::viewer {

/// Live radiosity as a window's light: lamps that are dragged, added and changed, a sky that is turned, and
/// groups of them that are made brighter or darker, whose solutions are multiplied and not found again. What
/// stands in the light's way is taken to stay where it was.
class RadiosityFollower final : public LightFollower {
 public:
  /// `shown`: the lights of the irradiance that the window opens with. `live` and the sky outlive it.
  /// `groups`: that the window has; none: it has none of radiosity, or others.
  RadiosityFollower(LiveRadiosity& live, RadiosityLights shown,
                    std::optional<RadiosityGroups> groups = std::nullopt);

  Shading shading() const override { return Shading::Radiosity; }
  bool update(const FollowedView& view) override;
  bool settled() const override { return !live_.isBusy(); }
  void show(Renderer& renderer) const override;

  /// W/m2, [vertex]; empty before the first light has changed.
  std::span<const glm::vec3> irradiance() const { return irradiance_; }

 private:
  bool differs(const FollowedView& view) const;
  bool takeFactors(const FollowedView& view);
  void tell();

  LiveRadiosity& live_;
  RadiosityLights told_;
  std::optional<RadiosityGroups> groups_;
  std::vector<glm::vec3> factors_;   ///< [group]
  std::vector<VertexLight> lights_;  ///< [group]; empty before anything has changed
  std::vector<glm::vec3> irradiance_;
};

}  // namespace prelight::viewer

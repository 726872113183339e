#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "radiosity/direct_light.h"

namespace prelight {

/// A group of lights with a separate solution. As radiosity is linear, scaling the group's brightness scales
/// its solution.
struct RadiosityGroup {
  std::string name;
  std::vector<std::size_t> lights = {};  ///< indices into RadiosityLights::punctual
  bool added = false;                    ///< whether it includes lights added later
  bool emitters = false;                 ///< whether it includes emissive triangles
  bool sky = false;                      ///< whether it includes the sky
};

/// Assigns lights to groups: each punctual light, the emissive triangles of a scene that has any, the sky,
/// and lights added later are separate groups.
class RadiosityGroups {
 public:
  /// `shown` are the initial lights; `emissive` says whether the scene has emissive triangles.
  RadiosityGroups(const RadiosityLights& shown, bool emissive);

  const std::vector<RadiosityGroup>& groups() const { return groups_; }
  std::vector<std::string> names() const;

  /// Returns the part of all lights that belongs to each group, [group].
  std::vector<RadiosityLights> deal(const RadiosityLights& all) const;

 private:
  std::vector<RadiosityGroup> groups_;
  std::size_t first_;  ///< number of initial lights
};

}  // namespace prelight

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "radiosity/direct_light.h"

namespace prelight {

/// A group of lights whose radiosity is solved by itself: radiosity is linear, so that a factor of the
/// group's brightness is one of its solution.
struct RadiosityGroup {
  std::string name;
  std::vector<std::size_t> lights = {};  ///< into RadiosityLights::punctual
  bool added = false;                    ///< and those after the lights that there were at first
  bool emitters = false;                 ///< and emissive triangles
  bool sky = false;                      ///< and the sky
};

/// Lights dealt to groups: every punctual one, emissive triangles where a scene has them, the sky,
/// and what will be added, each a group of its own.
class RadiosityGroups {
 public:
  /// `shown`: the lights there are at first; `emissive`: the scene has triangles that shine.
  RadiosityGroups(const RadiosityLights& shown, bool emissive);

  const std::vector<RadiosityGroup>& groups() const { return groups_; }
  std::vector<std::string> names() const;

  /// [group], what it has of all lights.
  std::vector<RadiosityLights> deal(const RadiosityLights& all) const;

 private:
  std::vector<RadiosityGroup> groups_;
  std::size_t first_;  ///< lights that there were at first
};

}  // namespace prelight

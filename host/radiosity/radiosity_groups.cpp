#include "radiosity/radiosity_groups.h"

#include <fmt/format.h>

#include "scene/light_sources.h"

namespace prelight {

RadiosityGroups::RadiosityGroups(const RadiosityLights& shown, bool emissive)
    : first_(shown.punctual.size()) {
  for (std::size_t i = 0; i < first_; ++i) {
    const Light& light = shown.punctual[i];
    groups_.push_back({.name = light.name.empty() ? fmt::format("light {}", i) : light.name, .lights = {i}});
  }
  if (emissive && shown.emitters) groups_.push_back({.name = "emissive surfaces", .emitters = true});
  if (shiningSky(shown.sky) != nullptr) groups_.push_back({.name = "sky", .sky = true});
  groups_.push_back({.name = "added lights", .added = true});
}

std::vector<std::string> RadiosityGroups::names() const {
  std::vector<std::string> names;
  for (const RadiosityGroup& group : groups_) names.push_back(group.name);
  return names;
}

std::vector<RadiosityLights> RadiosityGroups::deal(const RadiosityLights& all) const {
  std::vector<RadiosityLights> dealt;
  for (const RadiosityGroup& group : groups_) {
    RadiosityLights& own = dealt.emplace_back();
    own.emitters = group.emitters && all.emitters;
    if (group.sky) {
      own.sky = all.sky;
      own.skyRotation = all.skyRotation;
    }
    for (const std::size_t i : group.lights)
      if (i < all.punctual.size()) own.punctual.push_back(all.punctual[i]);
    for (std::size_t i = first_; group.added && i < all.punctual.size(); ++i)
      own.punctual.push_back(all.punctual[i]);
  }
  return dealt;
}

}  // namespace prelight

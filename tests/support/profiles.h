#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "prelight/scene.h"

namespace prelight::test {

/// A profile of type C with one height per degree and one turn per 5 degrees; `intensity` takes both in
/// radians.
inline std::shared_ptr<const LightProfile> makeProfile(const std::function<double(double, double)>& intensity,
                                                       int heights = 181, int turns = 73) {
  auto profile = std::make_shared<LightProfile>();
  for (int v = 0; v < heights; ++v) profile->heights.push_back(std::numbers::pi * v / (heights - 1));
  for (int h = 0; h < turns; ++h) profile->turns.push_back(2.0 * std::numbers::pi * h / (turns - 1));
  for (const double turn : profile->turns)
    for (const double height : profile->heights) profile->values.push_back(intensity(height, turn));
  return profile;
}

/// A lamp that shines along `direction`, with its X axis along `side`.
inline Light profiledLight(const glm::dvec3& position, std::shared_ptr<const LightProfile> profile,
                           const glm::dvec3& direction = {0, -1, 0}, const glm::dvec3& side = {1, 0, 0}) {
  Light light;
  light.position = position;
  light.profile = std::move(profile);
  light.direction = direction;
  light.side = side;
  return light;
}

/// Intensity max(cos(height), 0).
inline double cosineLobe(double height, double) { return std::max(std::cos(height), 0.0); }

}  // namespace prelight::test

#pragma once

#include <glm/glm.hpp>

#include "prelight/scene.h"

namespace prelight {

/// Most texels along a side of a cookie.
constexpr int mostCookieSide = 256;

/// A picture as cookies are: of at most mostCookieSide texels a side, those of larger ones averaged; what is
/// negative or no number is 0.
Picture cookieOf(const Picture& picture);

/// What a spot light's cookie lets through in a direction in which light leaves it: bilinear between the
/// texels of the square around the outer cone; beyond it that of the edge.
glm::dvec3 cookieTowards(const Light& light, const glm::dvec3& direction);

/// The mean of its texels.
glm::dvec3 cookieMean(const Picture& cookie);

}  // namespace prelight

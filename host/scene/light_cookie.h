#pragma once

#include <glm/glm.hpp>

#include "prelight/scene.h"

namespace prelight {

/// Greatest number of texels per side of a cookie.
constexpr int mostCookieSide = 256;

/// Returns a picture prepared as a cookie: at most mostCookieSide texels per side, averaged where it is
/// larger; negative values and NaN become 0.
Picture cookieOf(const Picture& picture);

/// Returns the share that a spot light's cookie lets through in a direction in which light leaves it:
/// bilinear between the texels of the square around the outer cone; outside the square the value at its edge.
glm::dvec3 cookieTowards(const Light& light, const glm::dvec3& direction);

/// Returns the mean of a cookie's texels.
glm::dvec3 cookieMean(const Picture& cookie);

}  // namespace prelight

#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight::viewer {

constexpr int measuredSteps = 33;  ///< of the view's cosine, as techniques/glossy/glossy.glsl has it

/// Reflection of measured BRDFs beyond their diffuse parts, for glossy transfer of an order (Kautz, Sloan and
/// Snyder 2002), [number][step][axis][band]: exit radiance is the sum over axes and bands of these times the
/// band of what arrives, in the axis' direction. `order` axes lie in the plane of view and normal, at equal
/// angles: so many zonal functions make any function of that order that is even about the plane. In the open
/// the sum is exactly the integral of BRDF, cosine and light of that order.
std::vector<glm::vec4> measuredLobes(const CompiledScene& scene, int order);

/// Unit direction of an axis; z: normal, x: towards the view.
glm::dvec3 axisOf(int axis, int order);

}  // namespace prelight::viewer

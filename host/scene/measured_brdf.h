#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "prelight/error.h"
#include "prelight/measured_brdf.h"

namespace prelight {

/// Makes a material of measured values, [half][difference][turn], 1/sr, below 0 where there are none: those
/// of neighbours take their place. Where light would leave brighter than it arrives, the values are scaled by
/// both directions, so that they stay reciprocal. Tells of both if it is much. Throws InputError where
/// nothing was measured.
MeasuredBrdf makeMeasuredBrdf(std::vector<glm::vec3> values, const std::string& where, Warnings& warnings);

/// What MeasuredBrdf::albedos holds for a direction of this cosine.
glm::dvec3 albedoAt(const std::vector<glm::vec3>& albedos, double cosine);

}  // namespace prelight

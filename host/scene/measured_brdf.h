#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "prelight/error.h"
#include "prelight/measured_brdf.h"

namespace prelight {

/// Returns a material for measured values, [half][difference][turn], 1/sr, which are below 0 where there are
/// none: those are filled from neighbours. Where more light would leave than arrives, the values are scaled
/// by factors of both directions, so that they stay reciprocal. Warns of both if the changes are large.
/// Throws InputError if there are no values.
MeasuredBrdf makeMeasuredBrdf(std::vector<glm::vec3> values, const std::string& where, Warnings& warnings);

/// Returns the interpolated MeasuredBrdf::albedos for a direction of this cosine.
glm::dvec3 albedoAt(const std::vector<glm::vec3>& albedos, double cosine);

}  // namespace prelight

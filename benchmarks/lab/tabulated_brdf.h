#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>

#include "prelight/measured_brdf.h"

namespace prelight {

/// BRDF of an isotropic surface whose normal is +Z, 1/sr in three channels, between two unit directions.
using BrdfModel = std::function<glm::dvec3(const glm::dvec3& wo, const glm::dvec3& wi)>;

/// A model as a measurement would have it: its values in the middles of the cells.
MeasuredBrdf tabulatedBrdf(const BrdfModel& model, const std::string& name);

/// GGX with height-correlated Smith masking that reflects `f0` at every microfacet, at the first bounce.
BrdfModel ggxModel(const glm::dvec3& f0, double roughness);

}  // namespace prelight

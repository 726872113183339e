#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>

#include "prelight/measured_brdf.h"
#include "prelight/scene.h"

namespace prelight {

/// Grooves with the profile of a sine, given as a normal texture, and the share of the sky that points in
/// them see. Lengths are in texels; grooves lie across the picture's rows.
namespace grooves {

constexpr int texels = 96;  ///< per side of the picture
constexpr double period = 32.0, amplitude = 6.0;

double heightAt(double x);
double slopeAt(double x);

Image normals();

/// Returns the share of an even sky's light that the bumped surface receives at x, by midpoints over the sky
/// and by marching over the heights along each direction.
double openAt(double x);

}  // namespace grooves

/// BRDF of an isotropic surface with normal +Z between two unit directions, 1/sr in three channels.
using BrdfModel = std::function<glm::dvec3(const glm::dvec3& wo, const glm::dvec3& wi)>;

/// Returns a model as if it had been measured: its values in the middles of the cells.
MeasuredBrdf tabulatedBrdf(const BrdfModel& model, const std::string& name);

/// Returns the first bounce of GGX with height-correlated Smith masking; every microfacet reflects `f0`.
BrdfModel ggxModel(const glm::dvec3& f0, double roughness);

}  // namespace prelight

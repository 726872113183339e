#pragma once

#include <glm/glm.hpp>

namespace prelight::test {

/// Share of light along `cosine` that a GGX surface reflects once, for the constant part (x) and the rise (y)
/// of Schlick's reflectance. It is a quadrature over `steps` x `steps` half vectors in double precision
/// (Walter et al. 2007, Heitz 2014).
glm::dvec2 reflectedOnce(double cosine, double roughness, int steps = 1000);

/// Mean of the sum of reflectedOnce() over directions, weighted by the cosine.
double meanReflectedOnce(double roughness);

/// Reflectance over all bounces of a surface with reflectance `f0` along its normal and `f90` at grazing
/// angles. Light that stays between microfacets hits them again, with their mean reflectance, and leaves by
/// their mean share (Kulla and Conty 2017, with Hill's correction).
glm::dvec3 reflectedAtLast(const glm::dvec3& f0, double f90, double cosine, double roughness);

}  // namespace prelight::test

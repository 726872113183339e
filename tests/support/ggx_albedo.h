#pragma once

#include <glm/glm.hpp>

namespace prelight::test {

/// Share of light along `cosine` that a GGX surface reflects once, of the constant part (x) and of the rise
/// (y) of Schlick's reflectance: quadrature over `steps` x `steps` half vectors in double precision (Walter
/// et al. 2007, Heitz 2014).
glm::dvec2 reflectedOnce(double cosine, double roughness, int steps = 1000);

/// Mean of what reflectedOnce() sums up to over directions, weighted by the cosine.
double meanReflectedOnce(double roughness);

/// What a surface of these reflectances along its normal and at grazing angles reflects at all bounces: what
/// one lets stay between microfacets meets them again, with their mean reflectance, and leaves by their mean
/// share (Kulla and Conty 2017, with Hill's correction).
glm::dvec3 reflectedAtLast(const glm::dvec3& f0, double f90, double cosine, double roughness);

}  // namespace prelight::test

#pragma once

#include <span>
#include <vector>

#include "receivers/fit_mesh.h"

namespace prelight {

/// Returns by how many times each slot of a fit may be smoothed more strongly, 1 to mostStiffness: more where
/// the curvature of the fitted function is within its noise. With a prior of variance t^2 for the Laplacian
/// and noise of variance s^2 in it, the best strength is proportional to s^2 / t^2, as in Wiener's filter.
///
/// `laplacian` is that of the fitted values, [slot] (NormalEquations::laplacian). `standardError` is that of
/// the values, [slot].
std::vector<double> stiffnessOf(const FitMesh& mesh, std::span<const double> laplacian,
                                std::span<const double> standardError);

constexpr double mostStiffness = 10.0;

}  // namespace prelight

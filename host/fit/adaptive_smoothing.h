#pragma once

#include <span>
#include <vector>

#include "receivers/fit_mesh.h"

namespace prelight {

/// How many times as strongly as elsewhere each slot of a fit may be smoothed, 1 to mostStiffness: more where
/// what the fit says of the surface's bending there is no more than its noise. With a prior of variance t^2
/// for the Laplacian and noise of variance s^2 in it, the best strength goes with s^2 / t^2, as in Wiener's
/// filter.
///
/// laplacian: of the fitted values, [slot] (NormalEquations::laplacian). standardError: of the values,
/// [slot].
std::vector<double> stiffnessOf(const FitMesh& mesh, std::span<const double> laplacian,
                                std::span<const double> standardError);

constexpr double mostStiffness = 10.0;

}  // namespace prelight

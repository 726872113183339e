#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fit/normal_equations.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// Fills slots that the equations do not determine, as no sample is near, with the means of their neighbours'
/// values, ring by ring away from the sampled slots, and smooths them a little. Slots that triangles connect
/// to no sampled slot become 0. `extent`, [slot], marks the slots that need values; empty: all. `x` is
/// [slot][column].
void extendFit(const FitMesh& mesh, const NormalEquations& equations, std::span<const std::uint8_t> extent,
               std::size_t columns, std::vector<float>& x);

}  // namespace prelight

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fit/normal_equations.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// Values for slots that the equations do not determine as no sample is near: the means of their neighbours',
/// ring by ring away from the sampled ones, smoothed a little. 0 where triangles lead to no sampled slot.
/// `extent`, [slot], says which of them need values; empty: all. `x` is [slot][column].
void extendFit(const FitMesh& mesh, const NormalEquations& equations, std::span<const std::uint8_t> extent,
               std::size_t columns, std::vector<float>& x);

}  // namespace prelight

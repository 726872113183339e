#pragma once

#include <vector>

namespace prelight {

/// The constants of kernels/project/sh_funcs.cl for an order, computed in double precision and rounded once:
/// [2 m] sectoral factors K_m, then [2 (n + l n + m)] and [.. + 1] the recurrence's a_lm and c_lm.
std::vector<float> makeShTable(int order);

}  // namespace prelight

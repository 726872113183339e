#pragma once

#include <vector>

namespace prelight {

/// Returns the constants of kernels/project/sh_funcs.cl for an order, computed in double precision and
/// rounded once: [2 m] sectoral factors K_m, then [2 (n + l n + m)] and [.. + 1] the recurrence's a_lm and
/// c_lm.
std::vector<float> makeShTable(int order);

/// Returns the constants of benchmarks/lab/kernels/sh_evaluate_funcs.cl for an order, four floats for each
/// (l, m), m <= l, at index l * order + m: b^2 and N, each as a sum of two floats. Y_lm = N sin^m {cos,
/// sin}(m phi) Q_l, where Q_l = z Q_(l-1) - b^2 Q_(l-2) has leading coefficient 1.
std::vector<float> makeMonicShTable(int order);

}  // namespace prelight

#pragma once

#include <vector>

/// Constants of harmonics for the device in other forms than the library's. Those of "cpherical harmonics" go
/// with the kernels of spherical harmonics, because the recurrences of both families have the same form.
namespace prelight {

/// Returns the constants of benchmarks/lab/kernels/sh_evaluate_funcs.cl for an order, four floats for each
/// (l, m), m <= l, at index l * order + m: b^2 and N, each as a sum of two floats. Y_lm = N sin^m {cos,
/// sin}(m phi) Q_l, where Q_l = z Q_(l-1) - b^2 Q_(l-2) has leading coefficient 1.
std::vector<float> makeMonicShTable(int order);

/// Returns the table that replaces makeShTable(), with which kernels/project/sh_funcs.cl computes C_i instead
/// of Y_i.
std::vector<float> makeChTable(int order);

/// Returns the table that replaces makeMonicShTable().
std::vector<float> makeMonicChTable(int order);

}  // namespace prelight

#pragma once

#include <vector>

/// Constants of "cpherical harmonics" for the device. The kernels are those of spherical harmonics, because
/// the recurrences of both families have the same form.
namespace prelight {

/// Returns the table that replaces makeShTable(), with which kernels/project/sh_funcs.cl computes C_i instead
/// of Y_i.
std::vector<float> makeChTable(int order);

/// Returns the table that replaces makeMonicShTable().
std::vector<float> makeMonicChTable(int order);

}  // namespace prelight

#pragma once

#include <vector>

/// Constants of "cpherical harmonics" for the device. The kernels are those of spherical harmonics: both
/// families are recurrences of one form.
namespace prelight {

/// In the place of makeShTable(), with which kernels/project/sh_funcs.cl yields C_i for Y_i.
std::vector<float> makeChTable(int order);

/// In the place of makeMonicShTable().
std::vector<float> makeMonicChTable(int order);

}  // namespace prelight

#pragma once

#include <glm/glm.hpp>
#include <span>

namespace prelight::sh {

/// Zonal coefficients of max(cos,0)/pi by band: the transfer of an unoccluded receiver with normal n is
/// T_lm = clampedCosine(l) Y_lm(n). (Ramamoorthi and Hanrahan 2001: A_l / pi.)
double clampedCosine(int band);

/// Transfer of an unoccluded receiver: T_i = clampedCosine(l) Y_i(normal).
void openTransfer(const glm::dvec3& normal, int order, std::span<double> values);

}  // namespace prelight::sh

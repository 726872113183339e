#pragma once

#include <cstdint>
#include <glm/glm.hpp>

/// The host's side of kernels/core/sampling_block_funcs.cl: the same integers, directions in double
/// precision.
namespace prelight::sampling {

/// Mixes a 32-bit integer bijectively.
std::uint32_t hashInteger(std::uint32_t x);

/// Point `index` of the Owen-scrambled (0,2)-sequence of `seed`, in [0,1)^2; the kernel's point to the last
/// bit.
glm::dvec2 sobol(std::uint32_t index, std::uint32_t seed);

/// Order in which a second sequence is walked beside a first: a random permutation within every aligned block
/// of 2^k indices. Without it, points of equal index of the two depend on each other, and sums over both do
/// not converge (Burley 2020, section 5, "padding").
std::uint32_t shuffledIndex(std::uint32_t index, std::uint32_t seed);

/// Point of the unit disc; areas stay in proportion, and squares compact (Shirley and Chiu 1997).
glm::dvec2 concentricDisc(const glm::dvec2& u);

/// Direction around unit `normal` of density cos/pi.
glm::dvec3 cosineHemisphere(const glm::dvec2& u, const glm::dvec3& normal);

/// Barycentric weights (of vertices 1 and 2) of uniform density on a triangle.
glm::dvec2 uniformTriangle(const glm::dvec2& u);

}  // namespace prelight::sampling

#pragma once

#include <cstdint>
#include <glm/glm.hpp>

/// Host version of kernels/core/sampling_block_funcs.cl: the same integers, and directions in double
/// precision.
namespace prelight::sampling {

/// Hashes a 32-bit integer bijectively.
std::uint32_t hashInteger(std::uint32_t x);

/// Returns point `index` of the Owen-scrambled (0,2)-sequence of `seed`, in [0,1)^2, which equals the
/// kernel's point bit for bit.
glm::dvec2 sobol(std::uint32_t index, std::uint32_t seed);

/// Returns the index at which a second sequence is read beside a first: a random permutation within every
/// aligned block of 2^k indices. Without it, points of equal index in the two sequences are correlated, and
/// sums over both do not converge (Burley 2020, section 5, "padding").
std::uint32_t shuffledIndex(std::uint32_t index, std::uint32_t seed);

/// Returns a point of the unit disc by a mapping that keeps area ratios and compactness (Shirley and Chiu
/// 1997).
glm::dvec2 concentricDisc(const glm::dvec2& u);

/// Returns a direction around unit `normal` with density cos/pi.
glm::dvec3 cosineHemisphere(const glm::dvec2& u, const glm::dvec3& normal);

/// Returns barycentric weights of vertices 1 and 2 with uniform density on a triangle.
glm::dvec2 uniformTriangle(const glm::dvec2& u);

}  // namespace prelight::sampling

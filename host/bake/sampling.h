#pragma once

#include <cstdint>
#include <glm/glm.hpp>

/// The host's side of kernels/core/sampling_funcs.cl: the same integers, directions in double precision.
namespace prelight::sampling {

/// Mixes a 32-bit integer bijectively.
std::uint32_t hashInteger(std::uint32_t x);

/// Point `index` of the Owen-scrambled (0,2)-sequence of `seed`, in [0,1)^2; the kernel's point to the last
/// bit.
glm::dvec2 sobol(std::uint32_t index, std::uint32_t seed);

/// Direction around unit `normal` of density cos/pi.
glm::dvec3 cosineHemisphere(const glm::dvec2& u, const glm::dvec3& normal);

/// Barycentric weights (of vertices 1 and 2) of uniform density on a triangle.
glm::dvec2 uniformTriangle(const glm::dvec2& u);

}  // namespace prelight::sampling

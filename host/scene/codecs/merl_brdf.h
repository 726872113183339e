#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace prelight {

/// Size in bytes of a file in MERL's format.
constexpr std::size_t merlHeaderBytes = 12, merlBytes = merlHeaderBytes + std::size_t{3} * 90 * 90 * 180 * 8;

/// Reads a measured BRDF in MERL's binary format (Matusik et al. 2003): three sizes and as many values in
/// double precision for red, green and blue, little-endian. Returns values in 1/sr, [half][difference][turn]
/// as in MeasuredBrdf; values that were not measured are below 0. Throws InputError, which names `where`.
std::vector<glm::vec3> parseMerlBrdf(std::span<const std::uint8_t> bytes, const std::string& where);

}  // namespace prelight

#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

// [1] Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem and Fairchild, "FLIP: A Difference Evaluator
// for Alternating
//     Images", Proc. ACM CGIT 3(2), 2020.

namespace prelight::benchmarks {

/// Pixels of a degree of the visual field at which [1] judges by default: 0.7 m before a monitor of 3840
/// pixels and 0.7 m.
constexpr double usualPixelsPerDegree = 67.02064;

/// FLIP of two pictures of one size for low dynamic range: how different they look when one takes the other's
/// place, 0 (alike) to 1, a pixel. Pixels are sRGB-encoded in [0,1], rows top to bottom; symmetric.
std::vector<float> flipMap(std::span<const glm::vec3> first, std::span<const glm::vec3> second, int width,
                           int height, double pixelsPerDegree = usualPixelsPerDegree);

/// Mean of flipMap.
double flip(std::span<const glm::vec3> first, std::span<const glm::vec3> second, int width, int height,
            double pixelsPerDegree = usualPixelsPerDegree);

}  // namespace prelight::benchmarks

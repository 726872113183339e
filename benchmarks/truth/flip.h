#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace prelight::benchmarks {

/// Two pictures as they are displayed: [row][column], sRGB-encoded in [0,1].
struct DisplayedPair {
  std::span<const glm::vec3> reference, test;
};

/// Whether FLIP can be measured: a Python with flip-evaluator is there.
bool canMeasureFlip();

/// The mean FLIP of each pair of pictures of one size, from 0 (alike) to 1, at 67 pixels per degree. Empty
/// where canMeasureFlip() is false.
std::vector<double> measureFlip(std::span<const DisplayedPair> pairs, int width, int height);

}  // namespace prelight::benchmarks

#pragma once

#include <glm/glm.hpp>
#include <random>

#include "prelight/device.h"

namespace prelight {

/// Each function prints a table of docs/notes/bases.md as Markdown to standard output.
void printOrthonormality(const Device& device);
void printRotationDrift();
void printRotationTimes();
void printBallShadows();

/// Returns a rotation from the uniform distribution.
glm::dmat3 randomRotation(std::mt19937& random);

}  // namespace prelight

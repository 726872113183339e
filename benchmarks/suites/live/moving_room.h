#pragma once

#include "benchmarks/run/measure.h"

namespace prelight::benchmarks {

/// A Cornell box of uneven walls with a cube ("Cube") and a glass ball ("Ball") in it, as the moving scenes
/// of Larsen (2004, ch. 14): each wall of cells x cells squares. 36 cells make 13 thousand triangles, 115
/// make 133 thousand. With one cell it is the plain box with two cubes, of 34.
BenchmarkScene makeMovingRoom(int cells);

}  // namespace prelight::benchmarks

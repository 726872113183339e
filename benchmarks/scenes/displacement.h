#pragma once

#include <cstdint>

#include "scene/builtin/mesh_shapes.h"

namespace prelight::benchmarks {

/// In [0,1), alike on every machine, unlike the distributions of the standard library.
inline double unitOf(std::uint32_t hash) { return hash * 0x1p-32; }

/// Moves vertices by smooth noise, a function of their place and of `seed` alone, so that surfaces that meet
/// still do. The same on every machine. Normals stay as they were.
void displace(MeshShape& shape, double amplitude, double frequency, double seed);

}  // namespace prelight::benchmarks

#pragma once

#include <cstdint>
#include <string>

#include "benchmarks/run/measure.h"

namespace prelight::benchmarks {

/// Four rooms joined by doors and full of objects, of about `triangles` triangles (1 k to 10 M): about three
/// tenths of them in uneven walls, the rest in instances of bumpy spheres, tori, cones, cylinders and boxes,
/// whose number grows with the power 0.4 of the triangles, as does their detail with 0.6. The same scene
/// anywhere for the same number. It has a light in each room and a camera; named as sizeName() says, its
/// meshes are not kept.
BenchmarkScene makeDetailedRooms(std::uint64_t triangles);

/// "250k", "2M".
std::string sizeName(std::uint64_t triangles);

}  // namespace prelight::benchmarks

#pragma once

#include <cstdint>
#include <string>

#include "benchmarks/run/measure.h"
#include "scene/gltf/gltf_document.h"

namespace prelight::benchmarks {

/// Returns four rooms that are joined by doors and full of objects, with about `triangles` triangles (1 k to
/// 10 M). About three tenths of them form uneven walls; the others are bumpy spheres, tori, cones, cylinders
/// and boxes. The number of objects grows with the power 0.4 of the triangles, their detail with the power
/// 0.6. The scene is the same on every machine. It has a light per room and a camera, is named by sizeName(),
/// and does not keep its meshes.
BenchmarkScene makeDetailedRooms(std::uint64_t triangles);

/// Returns a number of triangles as "250k" or "2M".
std::string sizeName(std::uint64_t triangles);

/// Returns bumpy balls in rows on a floor, with about `triangles` triangles (2 k or more). A tenth of them
/// form the floor; every ball is a mesh of its own. The scene is the same on every machine. No back faces are
/// visible, and no material has a texture.
GltfDocument makeBumpyBalls(std::uint64_t triangles);

}  // namespace prelight::benchmarks

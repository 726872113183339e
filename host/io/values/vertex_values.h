#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"

namespace prelight {

/// Copies `values`, `width` per vertex of a primitive, to their places in the values of the whole scene.
template <typename T>
void placeVertices(const std::vector<T>& values, const PrimitiveRanges& ranges, std::size_t width,
                   const CompiledScene& scene, std::vector<T>& target) {
  target.resize(width * scene.vertexCount());
  scatterVertices(values, ranges, width, target);
}

/// Reads one vector per vertex of a primitive.
std::vector<glm::vec3> readVectors(const ValueReader& values, const JsonCursor& json,
                                   const PrimitiveRanges& ranges);

/// Throws InputError unless a value that all primitives share is the same on all of them; the first one sets
/// it.
void expectSame(const JsonCursor& json, bool same, const char* what);

}  // namespace prelight

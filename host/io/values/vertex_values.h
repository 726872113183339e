#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "io/values/baked_ranges.h"
#include "io/values/value_reader.h"

namespace prelight {

/// Puts `values`, `width` of them a vertex of a primitive, into those of the whole scene.
template <typename T>
void placeVertices(const std::vector<T>& values, const PrimitiveRanges& ranges, std::size_t width,
                   const CompiledScene& scene, std::vector<T>& target) {
  target.resize(width * scene.vertexCount());
  scatterVertices(values, ranges, width, target);
}

/// A vector a vertex of a primitive.
std::vector<glm::vec3> readVectors(const ValueReader& values, const JsonCursor& json,
                                   const PrimitiveRanges& ranges);

/// All primitives must tell the same of what they share; the first sets it.
void expectSame(const JsonCursor& json, bool same, const char* what);

}  // namespace prelight

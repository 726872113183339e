#include "io/values/vertex_values.h"

#include <fmt/format.h>

namespace prelight {

std::vector<glm::vec3> readVectors(const ValueReader& reader, const JsonCursor& json,
                                   const PrimitiveRanges& ranges) {
  const std::vector<float> values = reader.floats(json, "VEC3", vertexCount(ranges));
  std::vector<glm::vec3> vectors;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3)
    vectors.emplace_back(values[i], values[i + 1], values[i + 2]);
  return vectors;
}

void expectSame(const JsonCursor& json, bool same, const char* what) {
  if (!same) json.fail(fmt::format("expected the {} of the other primitives", what), rebake);
}

}  // namespace prelight

#include "scene/surface/tangent_space.h"
#include "viewer/scene/surface.h"
#include "viewer/scene/tex_coords.h"
#include "viewer/web/page_parts.h"

namespace prelight::viewer {

void addGeometry(const RenderInputs& inputs, PageScene& page) {
  const CompiledScene& compiled = inputs.compiled;
  PageData& data = page.data;
  data.addFloats("positions", std::span(compiled.positions));
  data.addFloats("normals", std::span(compiled.normals));
  const std::vector<glm::vec4> coords = texCoords(compiled);
  if (!coords.empty()) data.addFloats("texCoords", std::span(coords));
  if (compiled.hasVertexColors()) data.addFloats("colors", std::span(compiled.colors));
  std::vector<std::uint32_t> corners;
  for (const glm::uvec3& triangle : compiled.triangles)
    corners.insert(corners.end(), {triangle.x, triangle.y, triangle.z});
  data.addWholes("triangles", corners);
  data.addFloats("triangleNormals", std::span<const glm::vec4>(geometricNormals(compiled)));
  if (compiled.needsTangents())
    data.addFloats("tangents", std::span<const glm::vec4>(cornerTangents(compiled)));
  page.description["vertices"] = compiled.vertexCount();
  page.description["triangles"] = compiled.triangleCount();
}

}  // namespace prelight::viewer

#include "charts/chart_vertices.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include "scene/gltf/accessor.h"
#include "scene/gltf/gltf_embed.h"

namespace prelight {

ChartVertices findChartVertices(const FileTriangles& triangles, const LightMapLayout& layout,
                                std::size_t firstFace, std::size_t vertexCount) {
  constexpr glm::vec2 unknown(-1.0f);
  ChartVertices result;
  result.originals = vertexCount;
  result.source.resize(vertexCount);
  std::iota(result.source.begin(), result.source.end(), 0u);
  result.coords.assign(vertexCount, unknown);
  std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> further;
  for (std::size_t t = 0; t < triangles.corners.size(); ++t)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = triangles.corners[t][static_cast<int>(corner)];
      result.indices.push_back(vertex);
      const std::optional<glm::vec2> place = cornerPlace(layout, triangles, firstFace, t, corner);
      if (!place) continue;
      glm::vec2& known = result.coords[vertex];
      if (known == unknown) known = *place;
      if (known == *place) continue;
      const auto [found, fresh] =
          further.try_emplace({vertex, place->x, place->y}, static_cast<std::uint32_t>(result.source.size()));
      if (fresh) {
        result.source.push_back(vertex);
        result.coords.push_back(*place);
      }
      result.indices.back() = found->second;
    }
  for (glm::vec2& coord : result.coords)
    if (coord == unknown) coord = glm::vec2(0.0f);
  return result;
}

namespace {

using Json = nlohmann::ordered_json;

int appendVertexAccessor(GltfDocument& document, Json accessor, std::span<const std::uint8_t> bytes,
                         std::size_t stride) {
  const int view = appendBufferView(document, bytes);
  document.json["bufferViews"][static_cast<std::size_t>(view)]["byteStride"] = stride;
  accessor["bufferView"] = view;
  document.json["accessors"].push_back(std::move(accessor));
  return static_cast<int>(document.json["accessors"].size()) - 1;
}

/// Returns the selected elements as the file stores them.
std::vector<std::uint8_t> gatherElements(const std::vector<std::uint8_t>& elements, std::size_t bytes,
                                         std::size_t stride, std::span<const std::uint32_t> source) {
  std::vector<std::uint8_t> gathered(stride * source.size(), 0);
  for (std::size_t i = 0; i < source.size(); ++i)
    std::memcpy(&gathered[i * stride], &elements[source[i] * bytes], bytes);
  return gathered;
}

std::vector<std::uint8_t> gatherSigned(const std::vector<float>& values, std::size_t components,
                                       std::span<const std::uint32_t> source,
                                       std::span<const std::uint8_t> negated) {
  std::vector<float> gathered;
  gathered.reserve(components * source.size());
  for (std::size_t i = 0; i < source.size(); ++i)
    for (std::size_t c = 0; c < components; ++c) {
      const float value = values[source[i] * components + c];
      gathered.push_back(negated[i] != 0 ? -value : value);
    }
  std::vector<std::uint8_t> bytes(gathered.size() * sizeof(float));
  std::memcpy(bytes.data(), gathered.data(), bytes.size());
  return bytes;
}

}  // namespace

int copyVertexAccessor(GltfDocument& document, std::size_t accessor, std::span<const std::uint32_t> source,
                       std::span<const std::uint8_t> negated) {
  constexpr int floatType = 5126;
  const AccessorReader reader(document, accessor);
  // The copy keeps the name, extras and extensions.
  Json copy = document.json["accessors"][accessor];
  for (const char* member : {"bufferView", "byteOffset", "sparse"}) copy.erase(member);
  copy["count"] = source.size();
  if (std::any_of(negated.begin(), negated.end(), [](std::uint8_t sign) { return sign != 0; })) {
    for (const char* member : {"normalized", "min", "max"}) copy.erase(member);
    copy["componentType"] = floatType;
    return appendVertexAccessor(document, std::move(copy),
                                gatherSigned(reader.floats(), reader.components(), source, negated),
                                reader.components() * sizeof(float));
  }
  const std::size_t bytes = elementBytes(reader.type(), static_cast<std::uint64_t>(reader.componentType()));
  const std::size_t stride = (bytes + 3) / 4 * 4;
  return appendVertexAccessor(document, std::move(copy),
                              gatherElements(reader.elements(), bytes, stride, source), stride);
}

}  // namespace prelight

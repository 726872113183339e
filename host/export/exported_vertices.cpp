#include "export/exported_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>
#include <vector>

#include "export/map_picture.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/gltf_embed.h"
#include "scene/gltf/load/file_triangles.h"

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

/// Ratio of the largest values of neighbouring ranges. The darkest range has no lower end.
constexpr float rangeWidth = 8.0f;
constexpr std::size_t mostRanges = 4;
/// Least share of the map's texels in a range. Smaller ranges join the next brighter one, as each range needs
/// separate primitives.
constexpr double leastShare = 0.05;

std::vector<float> largestOfCharts(const Picture& picture, const LightMapLayout& layout) {
  std::vector<float> largest(layout.chartCount, 0.0f);
  for (const LightMapTexel& texel : layout.texels) {
    const glm::vec3& value = picture.pixels[texel.texel];
    float& known = largest[layout.chartOf[texel.face]];
    known = std::max({known, value.x, value.y, value.z});
  }
  return largest;
}

/// Returns for each range the kept range that it joins. The first range is always kept.
std::array<std::uint8_t, mostRanges> placesOfRanges(const std::array<std::size_t, mostRanges>& texels,
                                                    std::size_t all) {
  std::array<std::uint8_t, mostRanges> place{};
  for (std::size_t range = 1; range < mostRanges; ++range) {
    const bool kept = static_cast<double>(texels[range]) >= leastShare * static_cast<double>(all);
    place[range] = static_cast<std::uint8_t>(place[range - 1] + (kept ? 1 : 0));
  }
  return place;
}

}  // namespace

int ChartRanges::at(const LightMapLayout& layout, std::size_t face) const {
  const std::uint32_t chart = layout.chartOf[face];
  return rangeOf.empty() || chart == LightMapLayout::noChart ? 0 : rangeOf[chart];
}

ChartRanges findChartRanges(const Picture& picture, const LightMapLayout& layout) {
  const std::vector<float> largest = largestOfCharts(picture, layout);
  if (largest.empty()) return {};
  const float most = *std::max_element(largest.begin(), largest.end());
  ChartRanges ranges;
  for (const float value : largest) {
    std::uint8_t range = 0;
    for (float least = most / rangeWidth; value <= least && range + 1u < mostRanges; least /= rangeWidth)
      ++range;
    ranges.rangeOf.push_back(range);
  }
  std::array<std::size_t, mostRanges> texels{};
  for (const LightMapTexel& texel : layout.texels) ++texels[ranges.rangeOf[layout.chartOf[texel.face]]];
  const std::array<std::uint8_t, mostRanges> place = placesOfRanges(texels, layout.texels.size());
  for (std::uint8_t& range : ranges.rangeOf) range = place[range];
  ranges.count = place.back() + 1;
  return ranges;
}

Picture pictureOfRange(const Picture& picture, const LightMapLayout& layout, const ChartRanges& ranges,
                       int range) {
  if (ranges.count == 1) return picture;
  std::vector<bool> filled(layout.texelCount(), false);
  for (const LightMapTexel& texel : layout.texels)
    filled[texel.texel] = ranges.at(layout, texel.face) == range;
  Picture part = picture;
  fillEmptyTexels(part, filled);
  return part;
}

namespace {

/// Returns the value that a hundredth of the colours exceed.
float brightest(const std::vector<glm::vec3>& irradiance) {
  std::vector<float> values;
  values.reserve(irradiance.size());
  for (const glm::vec3& value : irradiance) values.push_back(std::max({value.x, value.y, value.z}));
  if (values.empty()) return 1.0f;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at > 0.0f ? *at : 1.0f;
}

}  // namespace

BakedColors::BakedColors(const CompiledScene& scene, const Bake& bake, ExportForm form)
    : scene_(scene), bake_(bake), form_(form) {
  if (form == ExportForm::VertexLight) scale_ = brightest(*bake.irradiance) / std::numbers::pi_v<float>;
}

std::vector<glm::vec4> BakedColors::of(const PrimitiveRange& range, const CompiledMaterial* lamp) const {
  std::vector<glm::vec4> colors;
  colors.reserve(range.vertexCount);
  for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
    glm::vec3 baked = form_ == ExportForm::VertexLight
                          ? (*bake_.irradiance)[v] / (std::numbers::pi_v<float> * scale_)
                          : glm::vec3(bake_.ao[v]);
    const glm::vec4 own = scene_.hasVertexColors() ? scene_.colors[v] : glm::vec4(1.0f);
    baked *= glm::vec3(own);
    if (lamp != nullptr) baked = baked * lamp->baseColor + lamp->emission / scale_;
    colors.push_back(glm::clamp(glm::vec4(baked, own.a), glm::vec4(0.0f), glm::vec4(1.0f)));
  }
  return colors;
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

#include "charts/chart_coords.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "charts/chart_vertices.h"
#include "charts/light_map_charts.h"
#include "charts/make_light_map_layout.h"
#include "scene/gltf/charts.h"
#include "scene/gltf/load/file_triangles.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

/// Texels of a map per texel of the layout along a side: two leave a texel's width between charts, wherever
/// the map's texels lie.
constexpr double finer = 2.0;
constexpr double fillOfMaps = 0.7;  // share of its square that the charts of a map fill, about

/// A primitive of the file without coordinates, and the charts of its first instance.
struct Unwrapped {
  const PrimitiveRange* range = nullptr;
  LightMapCharts charts;
  LightMapLayout layout;
};

/// Returns whether a texture, of a material or of something within it, uses TEXCOORD_1.
bool usesSecondSet(const Json& json) {
  if (!json.is_structured()) return false;
  if (json.is_object() && json.contains("texCoord") && json["texCoord"] == 1) return true;
  return std::any_of(json.begin(), json.end(), usesSecondSet);
}

/// Returns whether extensions of a primitive use TEXCOORD_1, such as feature identifiers in a texture.
bool extensionsUseSecondSet(const GltfDocument& document, const Json& primitive) {
  if (!primitive.contains("extensions")) return false;
  if (usesSecondSet(primitive["extensions"])) return true;
  const Json::json_pointer textures("/extensions/EXT_structural_metadata/propertyTextures");
  return primitive.contains(textures) && document.json.contains(textures) &&
         usesSecondSet(document.json[textures]);
}

bool isSecondSetFree(const GltfDocument& document, const Json& primitive) {
  if (extensionsUseSecondSet(document, primitive)) return false;
  std::set<std::size_t> materials;
  if (primitive.contains("material")) materials.insert(primitive["material"].get<std::size_t>());
  const Json::json_pointer mappings("/extensions/KHR_materials_variants/mappings");
  if (primitive.contains(mappings))
    for (const Json& mapping : primitive[mappings])
      materials.insert(mapping.value("material", std::size_t{0}));
  return std::none_of(materials.begin(), materials.end(), [&](std::size_t material) {
    return usesSecondSet(document.json["materials"][material]);
  });
}

const Json& primitiveOf(const GltfDocument& document, const PrimitiveRange& range) {
  return document.json["meshes"][static_cast<std::size_t>(range.mesh)]["primitives"]
                      [static_cast<std::size_t>(range.primitive)];
}

/// Returns the primitives to unwrap, each with its charts.
std::vector<Unwrapped> findUnwrapped(const Scene& scene, const CompiledScene& compiled, const Charts& known,
                                     const GltfDocument& document) {
  std::set<std::pair<int, int>> done;
  for (const Chart& chart : known.charts) {
    const PrimitiveRange& range = compiled.primitives[chart.primitive];
    done.insert({range.mesh, range.primitive});
  }
  std::vector<Unwrapped> found;
  std::map<std::uint32_t, std::size_t> placeOf;  // by the last triangle of the range
  for (const PrimitiveRange& range : compiled.primitives) {
    if (range.triangleCount == 0 || !done.insert({range.mesh, range.primitive}).second) continue;
    if (!isSecondSetFree(document, primitiveOf(document, range))) continue;
    placeOf[range.firstTriangle + range.triangleCount - 1] = found.size();
    found.push_back({&range, {}, {}});
  }
  if (found.empty()) return found;
  for (LightMapChart& chart : makeLightMapCharts(scene, compiled, {}).charts) {
    const auto place = placeOf.lower_bound(chart.triangles.front());
    if (chart.back || place == placeOf.end()) continue;
    Unwrapped& own = found[place->second];
    if (chart.triangles.front() < own.range->firstTriangle) continue;
    own.charts.area += flatArea(chart);
    own.charts.charts.push_back(std::move(chart));
  }
  std::erase_if(found, [](const Unwrapped& own) { return own.charts.charts.empty(); });
  return found;
}

/// Returns the largest number of metres along a side of the known charts' squares.
double largestScale(const CompiledScene& compiled, const Charts& known) {
  double largest = 0.0;
  for (const Chart& chart : known.charts) {
    const PrimitiveRange& range = compiled.primitives[chart.primitive];
    double world = 0.0, flat = 0.0;
    for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t) {
      world += 0.5 * glm::length(geometricNormal(compiled, t));
      const glm::uvec3 v = compiled.triangles[t] - glm::uvec3(range.firstVertex);
      const glm::dvec2 b(chart.coords[v.y] - chart.coords[v.x]), c(chart.coords[v.z] - chart.coords[v.x]);
      flat += 0.5 * std::abs(b.x * c.y - b.y * c.x);
    }
    if (flat > 0.0) largest = std::max(largest, std::sqrt(world / flat));
  }
  return largest;
}

/// Lays all charts out with texels of one size, the largest map within `side` texels.
void layOut(const CompiledScene& compiled, double side, double leastTexel, std::vector<Unwrapped>& all,
            const Progress& progress) {
  double texel = leastTexel;
  for (const Unwrapped& own : all) texel = std::max(texel, std::sqrt(own.charts.area / fillOfMaps) / side);
  constexpr int mostTries = 64;
  for (int i = 0; i < mostTries; ++i) {
    int most = 0;
    for (Unwrapped& own : all) {
      progress.check();
      own.charts.texelSize = texel;
      own.layout = layOutLightMap(compiled, own.charts);
      most = std::max({most, own.layout.width, own.layout.height});
    }
    if (most <= side) return;
    texel *= std::max(1.05, most / side);
  }
}

/// Charts keep their proportions in the square of a map.
void useSquare(LightMapLayout& layout) {
  layout.width = layout.height = std::max(layout.width, layout.height);
}

void writeCoords(const Unwrapped& own, FileTrianglesFinder& finder, GltfDocument& document) {
  const PrimitiveRange& range = *own.range;
  LightMapLayout layout = own.layout;
  useSquare(layout);
  const ChartVertices vertices = findChartVertices(finder.of(range), layout, 0, range.vertexCount);
  Json primitive = primitiveOf(document, range);
  const auto copyAll = [&](Json& attributes) {
    attributes.erase("TEXCOORD_1");
    if (!vertices.isSplit()) return;
    for (auto& [name, accessor] : attributes.items())
      accessor = copyVertexAccessor(document, accessor.get<std::size_t>(), vertices.source);
  };
  copyAll(primitive["attributes"]);
  if (primitive.contains("targets"))
    for (Json& target : primitive["targets"]) copyAll(target);
  constexpr int floatType = 5126, unsignedType = 5125;
  const int coords = appendAccessor(document, std::as_bytes(std::span(vertices.coords)), "VEC2", floatType,
                                    vertices.coords.size());
  // Sets must be numbered without gaps.
  Json& attributes = primitive["attributes"];
  if (!attributes.contains("TEXCOORD_0")) attributes["TEXCOORD_0"] = coords;
  attributes["TEXCOORD_1"] = coords;
  if (vertices.isSplit()) {
    primitive["indices"] = appendAccessor(document, std::as_bytes(std::span(vertices.indices)), "SCALAR",
                                          unsignedType, vertices.indices.size());
    primitive.erase("mode");
  }
  document.json["meshes"][static_cast<std::size_t>(range.mesh)]["primitives"]
               [static_cast<std::size_t>(range.primitive)] = std::move(primitive);
}

}  // namespace

std::optional<GltfDocument> withChartCoords(const Scene& scene, const CompiledScene& compiled, int size,
                                            const GltfDocument& document, const Progress& progress) {
  const Charts known = makeCharts(scene, compiled, size);
  progress.check();
  std::vector<Unwrapped> all = findUnwrapped(scene, compiled, known, document);
  if (all.empty()) return std::nullopt;
  progress.check();
  const double side = std::max(1.0, size / finer);
  layOut(compiled, side, largestScale(compiled, known) / side, all, progress);
  GltfDocument written = document;
  FileTrianglesFinder finder(document, compiled);
  for (const Unwrapped& own : all) {
    progress.check();
    writeCoords(own, finder, written);
  }
  return written;
}

}  // namespace prelight

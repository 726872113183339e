#include "export/exported_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>

#include "export/exported_vertices.h"
#include "io/values/baked_ranges.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/load/file_triangles.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* instancingExtension = "EXT_mesh_gpu_instancing";
enum class Facing : std::uint8_t { Front, Back };

/// Calls visit(name, accessor) for the attributes of a primitive and of its morph targets.
template <class Visit>
void forEachAttribute(Json& primitive, Visit visit) {
  for (const auto& attribute : primitive["attributes"].items()) visit(attribute.key(), attribute.value());
  if (!primitive.contains("targets")) return;
  for (Json& target : primitive["targets"])
    for (const auto& attribute : target.items()) visit(attribute.key(), attribute.value());
}

class MeshExporter {
 public:
  MeshExporter(GltfDocument& document, const Scene& scene, const CompiledScene& compiled, const Bake& bake,
               const ExportRequest& request, const ChartMaps& maps)
      : document_(document),
        scene_(scene),
        compiled_(compiled),
        form_(request.form),
        layout_(maps.layout),
        ranges_(maps.ranges),
        colors_(compiled, bake, request.form),
        materials_(document, request.form, maps.textures) {
    for (const Json& node : document_.json["nodes"])
      if (node.contains("mesh")) ++usersOf_[node["mesh"].get<std::size_t>()];
    done_.colorScale = colors_.scale();
  }

  ExportedMeshes run() {
    // Triangles are found before the document's meshes change.
    for (const PrimitiveRange& range : compiled_.primitives)
      if (layout_ != nullptr || hasTurns(range)) triangles_.emplace(&range, finder_.of(range));
    std::map<int, std::vector<const PrimitiveRange*>> drawingsOf;
    for (const PrimitiveRange& range : compiled_.primitives) drawingsOf[range.node].push_back(&range);
    for (const auto& [node, ranges] : drawingsOf) exportNode(static_cast<std::size_t>(node), ranges);
    const std::vector<AnimatedCopies> materials = materials_.settle();
    copies_.insert(copies_.end(), materials.begin(), materials.end());
    animateCopies(document_.json, copies_);
    dropChannels(document_.json, [&](const std::string& pointer) { return isLostOcclusion(pointer); });
    const bool instanced =
        std::any_of(document_.json["nodes"].begin(), document_.json["nodes"].end(), [](const Json& node) {
          return node.contains("extensions") && node["extensions"].contains(instancingExtension);
        });
    if (!instanced) dropExtensionName(document_.json, instancingExtension);
    return done_;
  }

 private:
  bool hasChart(const PrimitiveRange& range, std::size_t firstFace) const {
    if (layout_ == nullptr) return false;
    for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t)
      if (layout_->chartOf[firstFace + t] != LightMapLayout::noChart) return true;
    return false;
  }

  /// Returns the FaceTurn bits of a triangle of the scene.
  std::uint8_t turnsOf(std::uint32_t triangle) const {
    return compiled_.triangleTurns.empty() || triangle == FileTriangles::dropped
               ? std::uint8_t{0}
               : compiled_.triangleTurns[triangle];
  }

  /// Returns whether triangles of an instance differ from the file's in winding or normals.
  bool hasTurns(const PrimitiveRange& range) const {
    for (std::uint32_t t = range.firstTriangle; t < range.firstTriangle + range.triangleCount; ++t)
      if (turnsOf(t) != 0) return true;
    return false;
  }

  /// Returns whether an instance is drawn on both sides although its material in the file is one-sided.
  bool isMadeTwoSided(const PrimitiveRange& range) const {
    if (range.triangleCount == 0) return false;
    const CompiledMaterial& drawn = compiled_.materials[compiled_.triangleMaterials[range.firstTriangle]];
    return drawn.doubleSided &&
           (drawn.source < 0 || !scene_.materials[static_cast<std::size_t>(drawn.source)].doubleSided);
  }

  /// Returns whether backs are exported separately. Occlusion is only known for fronts.
  bool hasBack(const PrimitiveRange& range) const {
    return form_ == ExportForm::LightMap && hasChart(range, compiled_.triangleCount());
  }

  bool isBaked(const PrimitiveRange& range) const {
    return colors_.present() || hasChart(range, 0) || hasBack(range);
  }

  void exportNode(std::size_t node, const std::vector<const PrimitiveRange*>& ranges) {
    if (std::none_of(ranges.begin(), ranges.end(), [&](const auto* range) { return isBaked(*range); }))
      return;
    std::map<int, std::vector<const PrimitiveRange*>> instances;
    for (const PrimitiveRange* range : ranges) instances[range->instance].push_back(range);
    const std::size_t mesh = document_.json["nodes"][node]["mesh"].get<std::size_t>();
    const Json::json_pointer instancing(fmt::format("/nodes/{}/extensions/{}", node, instancingExtension));
    const bool instanced = document_.json.contains(instancing);
    if (instanced) {
      for (const auto& [instance, drawn] : instances)
        addInstance(node, instance, appendMesh(madeMesh(mesh, drawn), mesh));
      dropInstancing(node);
      return;
    }
    Json made = madeMesh(mesh, instances.begin()->second);
    if (usersOf_[mesh]-- == 1)
      document_.json["meshes"][mesh] = std::move(made);
    else
      document_.json["nodes"][node]["mesh"] = appendMesh(std::move(made), mesh);
  }

  std::size_t appendMesh(Json mesh, std::size_t original) {
    document_.json["meshes"].push_back(std::move(mesh));
    const std::size_t added = document_.json["meshes"].size() - 1;
    copies_.push_back({fmt::format("/meshes/{}", original), {fmt::format("/meshes/{}", added)}});
    return added;
  }

  /// Returns whether a pointer animates an occlusion texture that was removed in favour of a light map.
  bool isLostOcclusion(const std::string& pointer) const {
    const std::string materials = "/materials/", member = "/occlusionTexture";
    const std::size_t end = pointer.find(member);
    if (!pointer.starts_with(materials) || end == std::string::npos) return false;
    const Json::json_pointer texture(pointer.substr(0, end + member.size()));
    return !document_.json.contains(texture);
  }

  void addInstance(std::size_t node, int instance, std::size_t mesh) {
    const auto found = std::find_if(scene_.meshNodes.begin(), scene_.meshNodes.end(),
                                    [&](const MeshNode& m) { return m.node == static_cast<int>(node); });
    Json child = {{"mesh", mesh}, {"matrix", Json::array()}};
    const glm::dmat4& matrix = found->instances.at(static_cast<std::size_t>(instance));
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row) child["matrix"].push_back(matrix[column][row]);
    const Json& parent = document_.json["nodes"][node];
    if (parent.contains("name"))
      child["name"] = fmt::format("{} {}", parent["name"].get<std::string>(), instance + 1);
    if (parent.contains("skin")) child["skin"] = parent["skin"];
    if (parent.contains("weights")) child["weights"] = parent["weights"];
    document_.json["nodes"].push_back(std::move(child));
    const std::size_t added = document_.json["nodes"].size() - 1;
    document_.json["nodes"][node]["children"].push_back(added);
    copies_.push_back(
        {fmt::format("/nodes/{}/weights", node), {fmt::format("/nodes/{}/weights", added)}, true});
  }

  void dropInstancing(std::size_t node) {
    Json& json = document_.json["nodes"][node];
    for (const char* member : {"mesh", "skin", "weights"}) json.erase(member);
    json["extensions"].erase(instancingExtension);
    if (json["extensions"].empty()) json.erase("extensions");
  }

  /// Returns a mesh with the primitives of one instance.
  Json madeMesh(std::size_t mesh, const std::vector<const PrimitiveRange*>& ranges) {
    Json made = document_.json["meshes"][mesh];
    Json primitives = Json::array();
    for (std::size_t p = 0; p < made["primitives"].size(); ++p) {
      const auto range = std::find_if(ranges.begin(), ranges.end(), [&](const PrimitiveRange* candidate) {
        return candidate->primitive == static_cast<int>(p);
      });
      if (range == ranges.end() || !isBaked(**range))
        primitives.push_back(made["primitives"][p]);
      else
        addPrimitives(made["primitives"][p], **range, primitives);
    }
    made["primitives"] = std::move(primitives);
    ++done_.drawings;
    return made;
  }

  /// Returns an emissive material without textures, which the export shows by vertex colours on an unlit
  /// material; nullptr if the primitive's is none or has variants, whose colours differ.
  const CompiledMaterial* lampOf(const Json& primitive, const PrimitiveRange& range) const {
    if (form_ != ExportForm::VertexLight || range.triangleCount == 0 || hasVariants(primitive))
      return nullptr;
    const CompiledMaterial& material = compiled_.materials[compiled_.triangleMaterials[range.firstTriangle]];
    const bool textured = material.emissionTexture.image >= 0 || material.baseColorTexture.image >= 0;
    return textured || material.emission == glm::vec3(0.0f) ? nullptr : &material;
  }

  void addPrimitives(const Json& original, const PrimitiveRange& range, Json& primitives) {
    if (colors_.present()) {
      const CompiledMaterial* lamp = lampOf(original, range);
      primitives.push_back(original);
      if (hasTurns(range)) turnAsDrawn(range, primitives.back());
      const std::vector<glm::vec4> colors = colors_.of(range, lamp);
      const std::span<const float> numbers(&colors[0].x, 4 * colors.size());
      primitives.back()["attributes"]["COLOR_0"] = appendValues(document_, numbers, "VEC4", 4);
      materials_.assign(primitives.back(), {.twoSided = isMadeTwoSided(range),
                                            .unlit = form_ == ExportForm::VertexLight,
                                            .glows = lamp != nullptr});
      return;
    }
    const bool back = hasBack(range);
    addSide(original, range, Facing::Front, back, primitives);
    if (!back) return;
    addSide(original, range, Facing::Back, true, primitives);
    ++done_.backs;
  }

  /// Adds one primitive per range that the charts of a side lie in.
  void addSide(Json primitive, const PrimitiveRange& range, Facing side, bool oneSided, Json& primitives) {
    const std::size_t firstFace = side == Facing::Back ? compiled_.triangleCount() : 0;
    const FileTriangles& triangles = triangles_.at(&range);
    ChartVertices vertices = findChartVertices(triangles, *layout_, firstFace, range.vertexCount);
    std::map<int, std::vector<std::uint32_t>> indicesOf = partIndices(vertices, triangles, side);
    if (vertices.isSplit() || side == Facing::Back || indicesOf.size() > 1 || hasTurns(range)) {
      copyVertices(primitive, vertices.source, negatedVertices(vertices, triangles, side));
      primitive["mode"] = 4;
      done_.split += vertices.source.size() - vertices.originals;
    } else {
      indicesOf.begin()->second.clear();  // keeps the primitive's indices
    }
    const int set = setCoords(primitive, vertices.coords);
    done_.parts += indicesOf.size() - 1;
    for (auto& [map, indices] : indicesOf) {
      Json part = primitive;
      if (!indices.empty()) part["indices"] = appendValues(document_, indices);
      materials_.assign(part, {.charted = true, .map = map, .texCoord = set, .oneSided = oneSided});
      primitives.push_back(std::move(part));
    }
  }

  /// Returns the vertex indices of each range, wound for that side. Triangles without a chart join the first
  /// range.
  std::map<int, std::vector<std::uint32_t>> partIndices(const ChartVertices& vertices,
                                                        const FileTriangles& triangles, Facing side) const {
    const std::size_t firstFace = side == Facing::Back ? compiled_.triangleCount() : 0;
    std::vector<std::optional<int>> rangeOf(triangles.corners.size());
    std::optional<int> first;
    for (std::size_t t = 0; t < rangeOf.size(); ++t) {
      const std::uint32_t compiled = triangles.compiled[t];
      if (compiled == FileTriangles::dropped) continue;
      if (layout_->chartOf[firstFace + compiled] == LightMapLayout::noChart) continue;
      rangeOf[t] = ranges_.at(*layout_, firstFace + compiled);
      if (!first) first = rangeOf[t];
    }
    std::map<int, std::vector<std::uint32_t>> indicesOf;
    for (std::size_t t = 0; t < rangeOf.size(); ++t) {
      std::vector<std::uint32_t>& indices = indicesOf[rangeOf[t].value_or(first.value_or(0))];
      indices.insert(indices.end(), &vertices.indices[3 * t], &vertices.indices[3 * t] + 3);
      const bool exchanged = (turnsOf(triangles.compiled[t]) & CornersExchanged) != 0;
      if (exchanged != (side == Facing::Back)) std::swap(indices.back(), *(indices.end() - 2));
    }
    return indicesOf;
  }

  /// Returns 1 per vertex whose normal on that side is the negative of the file's, [vertex].
  std::vector<std::uint8_t> negatedVertices(const ChartVertices& vertices, const FileTriangles& triangles,
                                            Facing side) const {
    std::vector<std::uint8_t> negated(vertices.source.size(), side == Facing::Back ? 1 : 0);
    for (std::size_t t = 0; t < triangles.compiled.size(); ++t)
      if ((turnsOf(triangles.compiled[t]) & NormalsNegated) != 0)
        for (std::size_t corner = 0; corner < 3; ++corner)
          negated[vertices.indices[3 * t + corner]] = side == Facing::Back ? 0 : 1;
    return negated;
  }

  void copyVertices(Json& primitive, std::span<const std::uint32_t> source,
                    std::span<const std::uint8_t> negated) {
    forEachAttribute(primitive, [&](const std::string& name, Json& accessor) {
      const bool follows = name == "NORMAL" || name == "TANGENT";
      accessor = copyVertexAccessor(document_, accessor.get<std::size_t>(), source,
                                    follows ? negated : std::span<const std::uint8_t>());
    });
  }

  /// Gives a primitive of the file the scene's winding and normals. Its vertices stay.
  void turnAsDrawn(const PrimitiveRange& range, Json& primitive) {
    const FileTriangles& triangles = triangles_.at(&range);
    ChartVertices vertices;
    vertices.source.resize(range.vertexCount);
    std::iota(vertices.source.begin(), vertices.source.end(), 0u);
    std::vector<std::uint32_t> indices;
    for (std::size_t t = 0; t < triangles.corners.size(); ++t) {
      const glm::uvec3& corners = triangles.corners[t];
      vertices.indices.insert(vertices.indices.end(), {corners.x, corners.y, corners.z});
      const bool exchanged = (turnsOf(triangles.compiled[t]) & CornersExchanged) != 0;
      indices.insert(indices.end(),
                     {corners.x, exchanged ? corners.z : corners.y, exchanged ? corners.y : corners.z});
    }
    copyVertices(primitive, vertices.source, negatedVertices(vertices, triangles, Facing::Front));
    primitive["indices"] = appendValues(document_, indices);
    primitive["mode"] = 4;
  }

  /// Adds the light map's texture coordinates and returns the index of their set.
  int setCoords(Json& primitive, const std::vector<glm::vec2>& coords) {
    const std::span<const float> numbers(&coords[0].x, 2 * coords.size());
    const int accessor = appendValues(document_, numbers, "VEC2", 2);
    int set = 1;
    if (primitive.contains("material"))
      set = texCoordSets(document_.json["materials"][primitive["material"].get<std::size_t>()]);
    Json& attributes = primitive["attributes"];
    // Sets must be numbered without gaps.
    for (int missing = 0; missing < set; ++missing) {
      const std::string name = fmt::format("TEXCOORD_{}", missing);
      if (!attributes.contains(name)) attributes[name] = accessor;
    }
    attributes[fmt::format("TEXCOORD_{}", set)] = accessor;
    return set;
  }

  GltfDocument& document_;
  const Scene& scene_;
  const CompiledScene& compiled_;
  ExportForm form_;
  const LightMapLayout* layout_;  ///< nullptr: there is no map
  const ChartRanges& ranges_;
  BakedColors colors_;
  ExportedMaterials materials_;
  FileTrianglesFinder finder_{document_, compiled_};
  std::map<const PrimitiveRange*, FileTriangles> triangles_;
  std::map<std::size_t, std::size_t> usersOf_;  ///< number of nodes per mesh
  std::vector<AnimatedCopies> copies_;
  ExportedMeshes done_;
};

}  // namespace

ExportedMeshes exportMeshes(GltfDocument& document, const Scene& scene, const CompiledScene& compiled,
                            const Bake& bake, const ExportRequest& request, const ChartMaps& maps) {
  return MeshExporter(document, scene, compiled, bake, request, maps).run();
}

}  // namespace prelight

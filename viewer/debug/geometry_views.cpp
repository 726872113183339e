#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bvh/builder.h"
#include "gi/global_illumination.h"
#include "receivers/surface_sampler.h"
#include "scene/surface/surface_regions.h"
#include "viewer/debug/debug_colors.h"
#include "viewer/debug/debug_rows.h"
#include "viewer/debug/map_layout.h"
#include "viewer/debug/marks.h"
#include "viewer/debug/surface_colors.h"

namespace prelight::viewer {
namespace {

constexpr double normalLength = 0.012;  ///< of lines along normals, share of the diagonal of the bounds
constexpr std::size_t mostReceivers = 200'000;

DebugLack lackOfTriangles(const RenderInputs& inputs) {
  if (inputs.compiled.triangleCount() > 0) return {};
  return {"the scene has no triangles", "choose a scene that has some"};
}

DebugLack lackOfVolume(const RenderInputs& inputs) {
  if (inputs.bake != nullptr && inputs.bake->volume) return {};
  return {"the bake has no volume", "bake with --volume 16, or add --volume 16"};
}

double diagonalOf(const CompiledScene& scene) { return glm::length(scene.boundsMax - scene.boundsMin); }

std::unique_ptr<DebugDrawing> drawNormals(const DebugInputs& of) {
  return drawSurfaceColors({Coloring::Normals}, of);
}

std::unique_ptr<DebugDrawing> drawUv(const DebugInputs& of) { return drawSurfaceColors({Coloring::Uv}, of); }

std::unique_ptr<DebugDrawing> drawAlbedo(const DebugInputs& of) {
  return drawSurfaceColors({Coloring::Albedo}, of);
}

/// Returns [edge], the vertices of edges of triangles, each edge of a pair of vertices once.
std::vector<std::pair<std::uint32_t, std::uint32_t>> edgesOf(const CompiledScene& scene) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * scene.triangles.size());
  for (const glm::uvec3& triangle : scene.triangles)
    for (int k = 0; k < 3; ++k) edges.emplace_back(std::minmax(triangle[k], triangle[(k + 1) % 3]));
  std::ranges::sort(edges);
  edges.erase(std::ranges::unique(edges).begin(), edges.end());
  return edges;
}

std::unique_ptr<DebugDrawing> drawWireframe(const DebugInputs& of) {
  const CompiledScene& scene = of.inputs.compiled;
  Marks marks;
  marks.lineWidth = 1.0f;
  const auto edges = edgesOf(scene);
  for (const auto& [a, b] : edges)
    marks.addLine(scene.positions[a], scene.positions[b], glm::vec3(0.75f, 0.45f, 0.05f));
  marks.legend =
      std::to_string(scene.triangleCount()) + " triangles, " + std::to_string(edges.size()) + " edges";
  return drawMarks(std::move(marks), scene);
}

std::unique_ptr<DebugDrawing> drawRegions(const DebugInputs& of) {
  const SurfaceRegions regions = makeSurfaceRegions(of.inputs.compiled, usualCreaseAngle);
  SurfaceColors colors{Coloring::Faces};
  for (int side = 0; side < 2; ++side)
    for (const std::uint32_t region : regions.regionOf) colors.colors.push_back(distinctColor(region));
  colors.legend = std::to_string(regions.count()) + " regions";
  return drawSurfaceColors(colors, of);
}

/// Returns the boxes of a tree at a level, and of leaves above it.
std::vector<Box> boxesAtLevel(const BinaryBvh& tree, int level) {
  std::vector<std::uint32_t> nodes = {0};
  for (int i = 0; i < level; ++i) {
    std::vector<std::uint32_t> below;
    for (const std::uint32_t n : nodes) {
      const BinaryBvh::Node& node = tree.nodes[n];
      if (node.count > 0)
        below.push_back(n);
      else
        below.insert(below.end(), {node.left, node.right});
    }
    if (below.size() == nodes.size()) break;
    nodes = std::move(below);
  }
  std::vector<Box> boxes;
  for (const std::uint32_t n : nodes) boxes.push_back(tree.nodes[n].bounds);
  return boxes;
}

std::unique_ptr<DebugDrawing> drawTree(const DebugInputs& of) {
  const CompiledScene& scene = of.inputs.compiled;
  const BinaryBvh tree = buildBvh(scene);
  const std::vector<Box> boxes = boxesAtLevel(tree, of.options.treeDepth);
  Marks marks;
  marks.shineThrough = true;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    marks.addBox(boxes[i].lower, boxes[i].upper, distinctColor(i));
  marks.legend = std::to_string(boxes.size()) + " boxes at level " + std::to_string(of.options.treeDepth) +
                 " of " + std::to_string(tree.depth) + ", " + std::to_string(tree.nodes.size()) +
                 " nodes in all";
  return drawMarks(std::move(marks), scene);
}

/// Returns the receivers at the texels of a layout, or else those of the first pass of a bake at vertices.
std::vector<device::Receiver> receiversOf(const RenderInputs& inputs) {
  const CompiledScene& scene = inputs.compiled;
  std::vector<device::Receiver> receivers;
  if (const LightMapLayout* layout = mapLayoutOf(inputs)) {
    for (const LightMapTexel& texel : layout->texels) receivers.push_back(receiverAt(scene, texel));
    return receivers;
  }
  const std::uint64_t seed = inputs.bake != nullptr ? inputs.bake->info.seed : 0;
  SurfaceSampler sampler(scene, seed, Side::Front);
  const std::size_t count = std::min<std::size_t>(scene.vertexCount(), mostReceivers);
  sampler.pass(static_cast<double>(count), 1, [&](const SurfaceSample&, const device::Receiver& receiver) {
    receivers.push_back(receiver);
  });
  return receivers;
}

std::unique_ptr<DebugDrawing> drawReceivers(const DebugInputs& of) {
  const CompiledScene& scene = of.inputs.compiled;
  const auto length = static_cast<float>(normalLength * diagonalOf(scene));
  const bool inTexels = mapLayoutOf(of.inputs) != nullptr;
  const std::vector<device::Receiver> receivers = receiversOf(of.inputs);
  Marks marks;
  marks.lineWidth = 1.0f;
  for (const device::Receiver& receiver : receivers) {
    const glm::vec3 place(receiver.position[0], receiver.position[1], receiver.position[2]);
    const glm::vec3 normal(receiver.normal[0], receiver.normal[1], receiver.normal[2]);
    marks.points.push_back({place, glm::vec3(0.75f, 0.55f, 0.05f)});
    marks.addLine(place, place + length * normal, 0.4f + 0.35f * normal);
  }
  marks.legend = std::to_string(receivers.size()) +
                 (inTexels ? " receivers, one in each texel" : " receivers of a pass over the surface");
  return drawMarks(std::move(marks), scene);
}

std::unique_ptr<DebugDrawing> drawProbes(const DebugInputs& of) {
  const VolumeTransfer& volume = *of.inputs.bake->volume;
  const glm::dvec3 origin = of.inputs.compiled.origin;
  const VolumeGrid& grid = volume.grid;
  const glm::dvec3 cell = (grid.max - grid.min) / glm::dvec3(grid.size);
  Marks marks;
  marks.pointSize = 5.0f;
  marks.shineThrough = true;
  marks.addBox(grid.min - origin, grid.max - origin, glm::vec3(0.6f));
  std::size_t inside = 0;
  for (std::size_t i = 0; i < grid.count(); ++i) {
    const auto column = static_cast<std::size_t>(grid.size.x), row = static_cast<std::size_t>(grid.size.y);
    const glm::dvec3 at(i % column, i / column % row, i / (column * row));
    const bool air = volume.air.empty() || volume.air[i] != 0;
    if (!air) ++inside;
    marks.points.push_back({grid.min + (at + 0.5) * cell - origin,
                            air ? glm::vec3(0.1f, 0.7f, 0.2f) : glm::vec3(0.8f, 0.08f, 0.05f)});
  }
  marks.legend = std::to_string(grid.count()) + " probes, " + std::to_string(inside) + " inside objects";
  return drawMarks(std::move(marks), of.inputs.compiled);
}

constexpr std::array<DebugRow, 8> geometryTable = {{
    {DebugView::Normals, lackOfTriangles, drawNormals},
    {DebugView::Uv, lackOfTriangles, drawUv},
    {DebugView::Albedo, lackOfTriangles, drawAlbedo},
    {DebugView::Wireframe, lackOfTriangles, drawWireframe},
    {DebugView::Regions, lackOfTriangles, drawRegions},
    {DebugView::Tree, lackOfTriangles, drawTree},
    {DebugView::Receivers, lackOfTriangles, drawReceivers},
    {DebugView::Probes, lackOfVolume, drawProbes},
}};

}  // namespace

std::span<const DebugRow> geometryRows() { return geometryTable; }

}  // namespace prelight::viewer

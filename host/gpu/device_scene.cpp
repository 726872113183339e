#include "gpu/device_scene.h"

#include <map>
#include <numbers>
#include <utility>

#include "base/spans.h"
#include "device/buffer.h"
#include "gpu/surface_upload.h"

namespace prelight {

using device::DeviceTriangle;
using device::SurfaceRange;

StoredSurface::StoredSurface(const CompiledScene& scene, std::span<const std::uint32_t> instances) {
  std::map<std::uint32_t, SurfaceRange> firstOf;  // by shape: where its first instance is stored
  std::uint32_t triangle = 0, vertex = 0;         // next to process
  for (const std::uint32_t i : instances) {
    const CompiledInstance& instance = scene.instances[i];
    const CompiledShape& shape = scene.shapes[instance.shape];
    addPart({triangle, instance.firstTriangle - triangle}, {vertex, instance.firstVertex - vertex});
    triangle = instance.firstTriangle + shape.triangleCount;
    vertex = instance.firstVertex + shape.vertexCount;
    const auto found = firstOf.find(instance.shape);
    if (found == firstOf.end()) {
      const SurfaceRange stored{0, storedTriangles_, storedVertices_, 0};
      firstOf[instance.shape] = stored;
      addPart({instance.firstTriangle, shape.triangleCount}, {instance.firstVertex, shape.vertexCount});
    } else {
      ranges_.push_back({instance.firstTriangle, found->second.triangleShift - instance.firstTriangle,
                         instance.firstVertex - found->second.vertexShift, 0});
    }
  }
  addPart({triangle, scene.triangleCount() - triangle}, {vertex, scene.vertexCount() - vertex});
}

void StoredSurface::addPart(const Part& triangles, const Part& vertices) {
  if (triangles.count == 0) return;
  ranges_.push_back(
      {triangles.first, storedTriangles_ - triangles.first, vertices.first - storedVertices_, 0});
  triangles_.push_back(triangles);
  vertices_.push_back(vertices);
  storedTriangles_ += triangles.count;
  storedVertices_ += vertices.count;
}

std::vector<DeviceTriangle> StoredSurface::triangles(const CompiledScene& scene) const {
  std::vector<DeviceTriangle> stored;
  stored.reserve(storedTriangles_);
  std::uint32_t firstVertex = 0;
  for (std::size_t p = 0; p < triangles_.size(); ++p) {
    const std::uint32_t shift = vertices_[p].first - firstVertex;
    for (std::uint32_t t = triangles_[p].first; t < triangles_[p].first + triangles_[p].count; ++t) {
      const glm::uvec3 corners = scene.triangles[t] - shift;
      stored.push_back({{corners.x, corners.y, corners.z}, scene.triangleMaterials[t]});
    }
    firstVertex += vertices_[p].count;
  }
  return stored;
}

using namespace device;

DeviceScene::DeviceScene(DeviceContext& device, const CompiledScene& scene,
                         std::vector<std::uint32_t> instances)
    : device_(&device), instances_(std::move(instances)), stored_(scene, instances_) {
  SurfaceArrays arrays = makeSurfaceArrays(scene);
  const bool textured = !arrays.texels.empty();
  PackedArrays<SurfaceLine> pack;
  layout_.triangles = pack.add(stored_.triangles(scene));
  layout_.rangeCount = static_cast<std::uint32_t>(stored_.ranges().size());
  layout_.ranges = pack.add(spanOf(stored_.ranges()));
  layout_.materials = pack.add(std::move(arrays.materials));
  layout_.textures = pack.add(std::move(arrays.textures));
  layout_.texels = pack.add(std::move(arrays.texels));
  if (textured) {
    layout_.texCoords = pack.add(stored_.ofVertices(spanOf(scene.texCoords)));
    layout_.texCoords1 = pack.add(stored_.ofVertices(spanOf(scene.texCoords1)));
  }
  if (scene.hasVertexColors()) layout_.colors = pack.add(stored_.ofVertices(spanOf(scene.colors)));
  surface_ = pack.upload(device);
  uploadLayout();
}

void DeviceScene::shareSurface(const DeviceScene& other) {
  if (surface_.memory() == other.surface_.memory()) return;
  stored_ = other.stored_;
  layout_.triangles = other.layout_.triangles;
  layout_.ranges = other.layout_.ranges;
  layout_.rangeCount = other.layout_.rangeCount;
  layout_.materials = other.layout_.materials;
  layout_.textures = other.layout_.textures;
  layout_.texCoords = other.layout_.texCoords;
  layout_.texCoords1 = other.layout_.texCoords1;
  layout_.colors = other.layout_.colors;
  layout_.texels = other.layout_.texels;
  surface_ = other.surface_;
  uploadLayout();
}

void DeviceScene::setShading(const CompiledScene& scene, const std::vector<Image>& images) {
  uploadShading(scene, makeShadeArrays(scene, images));
}

void DeviceScene::setPlainShading(const CompiledScene& scene) {
  uploadShading(scene, makePlainShadeArrays(scene));
}

void DeviceScene::setPaneShading(const CompiledScene& scene) { uploadShading(scene, makePaneArrays(scene)); }

void DeviceScene::uploadShading(const CompiledScene& scene, ShadeArrays arrays) {
  const bool textured = !arrays.texels.empty();
  PackedArrays<ShadingLine> pack;
  layout_.vertices = pack.add(interleaveVertices(scene));
  layout_.flat = pack.add(stored_.ofTriangles(spanOf(scene.triangleFlat)));
  layout_.bases = pack.add(std::move(arrays.bases));
  layout_.shadeMaterials = pack.add(std::move(arrays.materials));
  layout_.shadeTextures = pack.add(std::move(arrays.textures));
  layout_.shadeTexels = pack.add(std::move(arrays.texels));
  layout_.albedos = pack.add(std::move(arrays.albedos));
  layout_.measured = pack.add(std::move(arrays.measured));
  if (textured) {
    layout_.shadeTexCoords = pack.add(stored_.ofVertices(spanOf(scene.texCoords)));
    layout_.shadeTexCoords1 = pack.add(stored_.ofVertices(spanOf(scene.texCoords1)));
  }
  if (scene.needsTangents()) layout_.tangents = pack.add(packTangents(scene));
  shading_ = pack.upload(*device_);
  uploadLayout();
}

void DeviceScene::follow(const CompiledScene& scene) {
  shading_.writeArray(std::span<const float>(interleaveVertices(scene)), layout_.vertices);
  const std::vector<std::uint32_t> tangents =
      layout_.tangents > 0 ? packTangents(scene) : std::vector<std::uint32_t>();
  if (!tangents.empty()) shading_.writeArray(spanOf(tangents), layout_.tangents);
}

void DeviceScene::setLights(const LightTables& lights, double skyRotation) {
  PackedArrays<LightLine> pack;
  layout_.tables = pack.add(spanOf(lights.tables));
  layout_.emitters = pack.add(spanOf(lights.emitters));
  layout_.emitterDensities = pack.add(spanOf(lights.emitterDensities));
  layout_.emitterParts = pack.add(spanOf(lights.emitterParts));
  layout_.emitterRadiances = pack.add(spanOf(lights.emitterRadiances));
  layout_.emitterRoots = pack.add(spanOf(lights.emitterRoots));
  layout_.emitterNodes = pack.add(spanOf(lights.emitterNodes));
  layout_.punctual = pack.add(spanOf(lights.punctual));
  layout_.sky = pack.add(spanOf(lights.sky));
  layout_.profiles = pack.add(spanOf(lights.profiles));
  layout_.lights = lightLayout(lights, skyRotation);
  lights_ = pack.upload(*device_);
  uploadLayout();
}

void DeviceScene::setSkyRotation(double angle) {
  layout_.lights.skyTurn = skyTurn(angle);
  uploadLayout();
}

void DeviceScene::setOccluders(std::span<const std::uint32_t> flags, std::span<const std::uint32_t> groups) {
  PackedArrays<OccluderLine> pack;
  layout_.occluderFlags = pack.add(flags);
  layout_.occluderGroups = pack.add(groups);
  layout_.occluderVertices = pack.reserve<OccluderVertex>(groups.size());
  occluders_ = pack.upload(*device_);
  uploadLayout();
}

void DeviceScene::setOccluderVertices(std::span<const OccluderVertex> vertices) {
  occluders_.writeArray(vertices, layout_.occluderVertices);
}

/// Uploads the layout to a new buffer, because copies of the scene keep the old one.
void DeviceScene::uploadLayout() {
  layoutBuffer_ = Buffer<SceneLayout>(*device_, std::span<const SceneLayout>(&layout_, 1));
}

}  // namespace prelight

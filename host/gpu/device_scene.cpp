#include "gpu/device_scene.h"

#include <numbers>
#include <utility>

#include "base/span_of.h"
#include "device/packed_arrays.h"
#include "gpu/surface_arrays.h"
#include "gpu/surface_upload.h"

namespace prelight {

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

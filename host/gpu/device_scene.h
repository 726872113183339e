#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "device/buffer.h"
#include "gpu/light_tables.h"
#include "gpu/stored_surface.h"
#include "gpu/surface_upload.h"
#include "prelight/compiled_scene.h"
#include "shared/occluder_types.h"
#include "shared/scene_layout_types.h"

namespace prelight {

/// A scene on the device, as every kernel gets it: a few buffers of arrays, apart because not every kernel
/// needs them all and they change at different times, and one layout that tells where in them the arrays lie
/// (kernels/shared/scene_layout_types.h). Starts with the surface; what else a scene needs is added.
/// Copies share the buffers.
class DeviceScene {
 public:
  /// What rays and bounces ask of the surface. Shapes of `instances`, into CompiledScene::instances,
  /// ascending, are stored once.
  DeviceScene(DeviceContext& device, const CompiledScene& scene, std::vector<std::uint32_t> instances = {});

  /// Without a surface: see shareSurface().
  explicit DeviceScene(DeviceContext& device) : device_(&device) {}

  /// Takes the surface of another scene.
  void shareSurface(const DeviceScene& other);

  /// Adds what following light asks beyond that.
  void setShading(const CompiledScene& scene, const std::vector<Image>& images);

  /// The same without textures. Parts of emissive triangles tell what these emit (PRELIGHT_MEAN_EMISSION).
  void setPlainShading(const CompiledScene& scene);

  /// What shadow rays ask of panes alone (kernels/transport/straight_funcs.cl).
  void setPaneShading(const CompiledScene& scene);

  /// Takes vertices for shading to where the scene has them now.
  void follow(const CompiledScene& scene);

  /// `skyRotation`: radians, counter-clockwise about +Y seen from above.
  void setLights(const LightTables& lights, double skyRotation);
  void setSkyRotation(double angle);

  /// Adds what occluders are told apart by: flags [material] PRELIGHT_OCCLUDER_*, groups [vertex].
  void setOccluders(std::span<const std::uint32_t> flags, std::span<const std::uint32_t> groups);

  /// [vertex], as many as setOccluders() had groups.
  void setOccluderVertices(std::span<const device::OccluderVertex> vertices);

  /// Those whose shapes are stored once; where there are any, programs are built with
  /// PRELIGHT_SHARED_SURFACE.
  const std::vector<std::uint32_t>& instances() const { return instances_; }

  const device::SceneLayout& layout() const { return layout_; }
  const Buffer<device::SceneLayout>& layoutBuffer() const { return layoutBuffer_; }
  const Buffer<device::SurfaceLine>& surface() const { return surface_; }
  const Buffer<device::ShadingLine>& shading() const { return shading_; }
  const Buffer<device::LightLine>& lights() const { return lights_; }
  const Buffer<device::OccluderLine>& occluders() const { return occluders_; }
  DeviceContext& context() const { return *device_; }

 private:
  void uploadShading(const CompiledScene& scene, ShadeArrays arrays);
  void uploadLayout();

  DeviceContext* device_;
  std::vector<std::uint32_t> instances_;
  StoredSurface stored_;
  device::SceneLayout layout_{};
  Buffer<device::SceneLayout> layoutBuffer_;
  Buffer<device::SurfaceLine> surface_;
  Buffer<device::ShadingLine> shading_;
  Buffer<device::LightLine> lights_;
  Buffer<device::OccluderLine> occluders_;
};

}  // namespace prelight

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "device/buffer.h"
#include "gpu/device_scene.h"
#include "gpu/light_tables.h"
#include "gpu/surface_upload.h"
#include "prelight/compiled_scene.h"
#include "shared/occluder_types.h"
#include "shared/scene_layout_types.h"
#include "shared/scene_types.h"

namespace prelight {

/// The triangles and vertices of a scene that are stored on the device when instances share shapes, and the
/// map from the scene's triangles to them.
class StoredSurface {
 public:
  StoredSurface() = default;  ///< stores nothing

  /// `instances` are indices into CompiledScene::instances, ascending; if empty, everything is stored.
  StoredSurface(const CompiledScene& scene, std::span<const std::uint32_t> instances);

  const std::vector<device::SurfaceRange>& ranges() const { return ranges_; }

  /// Returns the values of stored triangles, [stored triangle], from values [triangle].
  template <typename T>
  std::vector<T> ofTriangles(std::span<const T> values) const {
    return chosen(values, triangles_);
  }

  /// Returns the values of stored vertices, [stored vertex], from values [vertex], which may be empty.
  template <typename T>
  std::vector<T> ofVertices(std::span<const T> values) const {
    return chosen(values, vertices_);
  }

  /// Returns the stored triangles with indices of stored vertices.
  std::vector<device::DeviceTriangle> triangles(const CompiledScene& scene) const;

 private:
  struct Part {
    std::uint32_t first = 0, count = 0;
  };

  template <typename T>
  static std::vector<T> chosen(std::span<const T> values, const std::vector<Part>& parts) {
    std::vector<T> all;
    if (values.empty()) return all;
    for (const Part& part : parts) {
      const auto of = values.subspan(part.first, part.count);
      all.insert(all.end(), of.begin(), of.end());
    }
    return all;
  }

  void addPart(const Part& triangles, const Part& vertices);

  std::vector<Part> triangles_;  ///< stored one after another
  std::vector<Part> vertices_;   ///< as many parts as triangles_
  std::uint32_t storedTriangles_ = 0;
  std::uint32_t storedVertices_ = 0;
  std::vector<device::SurfaceRange> ranges_;
};

/// A scene on the device, as every kernel gets it: a few buffers of arrays and one layout that says where in
/// them the arrays lie (kernels/shared/scene_layout_types.h). The buffers are separate because not every
/// kernel needs all of them and they change at different times. It starts with the surface; other parts are
/// added as needed. Copies share the buffers.
class DeviceScene {
 public:
  /// Uploads the surface data that rays and bounces need. Shapes of `instances`, indices into
  /// CompiledScene::instances, ascending, are stored once.
  DeviceScene(DeviceContext& device, const CompiledScene& scene, std::vector<std::uint32_t> instances = {});

  /// Makes a scene without a surface: see shareSurface().
  explicit DeviceScene(DeviceContext& device) : device_(&device) {}

  /// Uses the surface of another scene.
  void shareSurface(const DeviceScene& other);

  /// Adds the material data that light transport needs.
  void setShading(const CompiledScene& scene, const std::vector<Image>& images);

  /// Adds material data without textures. Parts of emissive triangles hold their emission
  /// (PRELIGHT_MEAN_EMISSION).
  void setPlainShading(const CompiledScene& scene);

  /// Adds only the material data of panes that shadow rays need (kernels/transport/straight_funcs.cl).
  void setPaneShading(const CompiledScene& scene);

  /// Updates the shading vertices to the scene's present ones.
  void follow(const CompiledScene& scene);

  /// Sets the lights. `skyRotation` is in radians, counter-clockwise about +Y seen from above.
  void setLights(const LightTables& lights, double skyRotation);
  void setSkyRotation(double angle);

  /// Adds data that distinguishes occluders: flags [material], PRELIGHT_OCCLUDER_*, and groups [vertex].
  void setOccluders(std::span<const std::uint32_t> flags, std::span<const std::uint32_t> groups);

  /// Sets the occluder vertices, [vertex], as many as setOccluders() had groups.
  void setOccluderVertices(std::span<const device::OccluderVertex> vertices);

  /// Returns the instances whose shapes are stored once. If there are any, programs are built with
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

#pragma once

#include <memory>
#include <vector>

#include "gpu/device_scene.h"
#include "gpu/light_tables.h"
#include "gpu/shade_features.h"
#include "gpu/tracer.h"
#include "prelight/picture.h"

namespace prelight {

/// A scene with everything that lights it. The referents must outlive objects made of it.
struct LitScene {
  const CompiledScene& scene;
  const std::vector<Image>& images;  ///< Scene::images
  std::vector<Light> lights;         ///< punctual lights in world space
  const Environment* sky = nullptr;
  double skyRotation = 0.0;  ///< radians, counter-clockwise about +Y seen from above
};

/// A lit scene on the device, for light transport kernels.
class TransportScene {
 public:
  /// `choosePunctual` is as in makeLightTables(). The scene must have a triangle.
  TransportScene(const LitScene& lit, const Device& device, bool choosePunctual = true);

  /// Uses an existing tracer of the scene, which must outlive this.
  TransportScene(const LitScene& lit, Tracer& tracer, bool choosePunctual = true);

  /// Updates vertices of triangles that the tracer has separated (Tracer::separate) to the scene's present
  /// ones.
  void follow(const CompiledScene& scene);

  /// Replaces the punctual lights by as many of equal types. Returns true if options() have changed, so that
  /// programs must be rebuilt: dark lights shine now, or all are dark.
  bool setLights(const CompiledScene& scene, const std::vector<Light>& lights);

  /// Turns the sky: radians, counter-clockwise about +Y seen from above.
  void setSkyRotation(double angle);

  /// Returns surface, shading and lights.
  const DeviceScene& handle() const { return handle_; }

  /// Returns the options for programs that access the scene.
  BuildOptions options() const;

  Tracer& tracer() { return *tracer_; }
  DeviceContext& context() const { return tracer_->context(); }
  const LightTables& lights() const { return tables_; }
  const ShadeFeatures& features() const { return features_; }

 private:
  TransportScene(const LitScene& lit, std::unique_ptr<Tracer> own, Tracer* tracer, bool choosePunctual);

  std::unique_ptr<Tracer> ownTracer_;
  Tracer* tracer_;
  const Environment* sky_;
  double skyRotation_;
  bool choosePunctual_;
  LightTables tables_;
  ShadeFeatures features_;
  DeviceScene handle_;
};

}  // namespace prelight

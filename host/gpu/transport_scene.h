#pragma once

#include <memory>
#include <vector>

#include "gpu/device_scene.h"
#include "gpu/light_tables.h"
#include "gpu/shade_features.h"
#include "gpu/tracer.h"
#include "prelight/picture.h"

namespace prelight {

/// A scene and all that lights it. The referents outlive what is made of it.
struct LitScene {
  const CompiledScene& scene;
  const std::vector<Image>& images;  ///< Scene::images
  std::vector<Light> lights;         ///< punctual ones, world space
  const Environment* sky = nullptr;
  double skyRotation = 0.0;  ///< radians, counter-clockwise about +Y seen from above
};

/// A lit scene on the device, for kernels that follow light through it.
class TransportScene {
 public:
  /// `choosePunctual`: as makeLightTables(). The scene must have a triangle.
  TransportScene(const LitScene& lit, const Device& device, bool choosePunctual = true);

  /// With the scene's tracer, which outlives it.
  TransportScene(const LitScene& lit, Tracer& tracer, bool choosePunctual = true);

  /// Takes vertices of triangles that the tracer has separated (Tracer::separate) to where the scene has them
  /// now.
  void follow(const CompiledScene& scene);

  /// From now on these punctual lights shine, as many and of the same types as before, each in its place.
  /// True: options() are others now, and programs have to be built anew, as lights that were dark shine or
  /// all are dark.
  bool setLights(const CompiledScene& scene, const std::vector<Light>& lights);

  /// Turns the sky: radians, counter-clockwise about +Y seen from above.
  void setSkyRotation(double angle);

  /// Surface, shading and lights.
  const DeviceScene& handle() const { return handle_; }

  /// Options that programs which look at it are built with.
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

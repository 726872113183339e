#pragma once

#include <memory>
#include <vector>

#include "device/context.h"
#include "gpu/device_scene.h"
#include "gpu/light_tables.h"
#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/picture.h"

namespace prelight {

/// Features that a scene needs of the kernels in kernels/transport, which are built with only these.
struct ShadeFeatures {
  bool punctual = false;
  bool profiles = false;  ///< some punctual light has a profile
  bool emitters = false;
  bool emitterParts = false;  ///< some emitters are parts of triangles
  bool sky = false;
  bool glass = false;
  bool panes = false;  ///< light passes straight through some glass
  bool roughGlass = false;
  bool anisotropic = false;    ///< some rough lobe is wider in one direction than in the other
  bool film = false;           ///< a thin film colours some reflection
  bool dispersion = false;     ///< some glass refracts by wavelength
  bool measured = false;       ///< some surface has a measured BRDF
  bool filmGlass = false;      ///< some glass lies under a thin film
  bool specularGlass = false;  ///< some glass has another reflectance than its index of refraction gives
  bool layers = false;         ///< some surface has a clear coat or a sheen
  bool mirror = false;
  bool glossy = false;
  bool absorption = false;
  bool media = false;  ///< some body scatters light inside
  bool textures = false;
  bool bumps = false;        ///< some surface has a normal texture
  bool translucent = false;  ///< some surface lets light through diffusely
  bool scatters = false;     ///< some surface scatters or transmits light
  bool culled = false;       ///< some surface is one-sided, so that pictures do not show its back

  /// Returns whether some surface scatters light other than diffusely.
  bool specularLobes() const { return glass || mirror || glossy; }
};

ShadeFeatures findShadeFeatures(const CompiledScene& scene, const LightTables& lights);

/// Returns the features that paneTransmittance() of kernels/transport needs for the scene's panes.
ShadeFeatures findPaneFeatures(const CompiledScene& scene);

/// Adds the build options of kernels/transport.
BuildOptions& defineFeatures(const ShadeFeatures& features, BuildOptions& options);

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

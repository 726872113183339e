#pragma once

#include "device/build_options.h"
#include "gpu/light_tables.h"
#include "prelight/compiled_scene.h"

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

}  // namespace prelight

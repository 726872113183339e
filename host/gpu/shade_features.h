#pragma once

#include "device/build_options.h"
#include "gpu/light_tables.h"
#include "prelight/compiled_scene.h"

namespace prelight {

/// What a scene needs of the kernels that follow light (kernels/transport): they are built with no more.
struct ShadeFeatures {
  bool punctual = false;
  bool profiles = false;  ///< of punctual lights
  bool emitters = false;
  bool emitterParts = false;  ///< some are parts of triangles
  bool sky = false;
  bool glass = false;
  bool panes = false;  ///< light goes straight through some of it
  bool roughGlass = false;
  bool anisotropic = false;    ///< some rough lobe is wider one way than the other
  bool film = false;           ///< a thin film colours some reflection
  bool dispersion = false;     ///< some glass refracts by wavelength
  bool measured = false;       ///< some surface reflects as was measured
  bool filmGlass = false;      ///< some lies under a thin film
  bool specularGlass = false;  ///< some reflects otherwise than its index of refraction tells
  bool layers = false;         ///< some surface has a clear coat or a sheen
  bool mirror = false;
  bool glossy = false;
  bool absorption = false;
  bool media = false;  ///< some body scatters light within
  bool textures = false;
  bool bumps = false;        ///< some surface has a normal texture
  bool translucent = false;  ///< some surface lets light through diffusely
  bool scatters = false;     ///< some surface sends light on
  bool culled = false;       ///< some surface is one-sided: pictures do not show its back

  /// Some surface sends light on otherwise than diffusely.
  bool specularLobes() const { return glass || mirror || glossy; }
};

ShadeFeatures findShadeFeatures(const CompiledScene& scene, const LightTables& lights);

/// What paneTransmittance() of kernels/transport needs of the scene's panes.
ShadeFeatures findPaneFeatures(const CompiledScene& scene);

/// Adds the options of kernels/transport.
BuildOptions& defineFeatures(const ShadeFeatures& features, BuildOptions& options);

}  // namespace prelight

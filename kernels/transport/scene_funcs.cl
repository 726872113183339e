// Access to a scene with lights in its buffers. Options: those of the included files.
#ifndef PRELIGHT_TRANSPORT_SCENE_FUNCS_CL
#define PRELIGHT_TRANSPORT_SCENE_FUNCS_CL

#include "shared/scene_layout_types.h"
#include "transport/light_funcs.cl"
#include "transport/shaded_surface_funcs.cl"

// A scene with its lights.
typedef struct Scene {
  PathScene surface;
  Lights lights;
} Scene;

PRELIGHT_INLINE Lights lightsOf(__constant const SceneLayout* layout, __global const LightLine* lights) {
  const Lights l = {(__global const uint*)(lights + layout->tables), (__global const uint*)(lights + layout->emitters),
                    (__global const float*)(lights + layout->emitterDensities),
#ifdef PRELIGHT_EMITTER_PARTS
                    (__global const float4*)(lights + layout->emitterParts),
                    (__global const float4*)(lights + layout->emitterRadiances),
                    (__global const uint*)(lights + layout->emitterRoots), (__global const uint*)(lights + layout->emitterNodes),
#endif
                    (__global const PunctualLight*)(lights + layout->punctual),
                    (__global const float4*)(lights + layout->sky)
#ifdef PRELIGHT_PROFILES
                    , (__global const float4*)(lights + layout->profiles)
#endif
  };
  return l;
}

PRELIGHT_INLINE Scene sceneOf(__constant const SceneLayout* layout, __global const SurfaceLine* surface,
                              __global const ShadingLine* shading, __global const LightLine* lights) {
  const Scene scene = {shadedSurfaceOf(layout, surface, shading), lightsOf(layout, lights)};
  return scene;
}

#endif

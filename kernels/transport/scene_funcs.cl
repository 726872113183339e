// A lit scene in its buffers, as functions read it. Options: those of the included files.
#ifndef PRELIGHT_TRANSPORT_SCENE_FUNCS_CL
#define PRELIGHT_TRANSPORT_SCENE_FUNCS_CL

#include "shared/scene_layout_types.h"
#include "transport/light_funcs.cl"
#include "transport/material_funcs.cl"

typedef struct Scene {
  PathScene surface;
  Lights lights;
} Scene;

PRELIGHT_INLINE PathScene shadedSurfaceOf(__constant const SceneLayout* layout, __global const SurfaceLine* surface,
                                          __global const ShadingLine* shading) {
  const Surface base = {(__global const DeviceTriangle*)(surface + layout->triangles),
                        (__global const SurfaceRange*)(surface + layout->ranges), layout->rangeCount,
                        (__global const DeviceMaterial*)(shading + layout->bases),
                        (__global const DeviceTexture*)(shading + layout->shadeTextures),
                        (__global const float2*)(shading + layout->shadeTexCoords),
                        (__global const float2*)(shading + layout->shadeTexCoords1),
                        (__global const float4*)(surface + layout->colors),
                        (__global const ushort4*)(shading + layout->shadeTexels)};
  const PathScene s = {base,
                       (__global const float*)(shading + layout->vertices),
                       (__global const uchar*)(shading + layout->flat),
                       (__global const uint*)(shading + layout->tangents),
                       (__global const ShadeMaterial*)(shading + layout->shadeMaterials),
                       (__global const float4*)(shading + layout->albedos),
                       (__global const float*)(shading + layout->measured)};
  return s;
}

PRELIGHT_INLINE Lights lightsOf(__constant const SceneLayout* layout, __global const LightLine* lights) {
  const Lights l = {(__global const uint*)(lights + layout->tables), (__global const uint*)(lights + layout->emitters),
                    (__global const float*)(lights + layout->emitterDensities),
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

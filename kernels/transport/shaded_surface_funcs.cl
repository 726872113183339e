// Access to a scene's surface and materials in its buffers. Options: those of the included files.
#ifndef PRELIGHT_TRANSPORT_SHADED_SURFACE_FUNCS_CL
#define PRELIGHT_TRANSPORT_SHADED_SURFACE_FUNCS_CL

#include "shared/scene_layout_types.h"
#include "transport/material_funcs.cl"

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

#endif

// Places of a scene's arrays in its buffers. This is the only list of them: host/gpu/device_scene.cpp fills
// it, and surfaceOf (transport/alpha_funcs.cl) and sceneOf (transport/scene_funcs.cl) read it.
#ifndef PRELIGHT_SHARED_SCENE_LAYOUT_TYPES_H
#define PRELIGHT_SHARED_SCENE_LAYOUT_TYPES_H

#include "shared/compat.h"
#include "shared/shade_types.h"

PRELIGHT_SHARED_BEGIN

/// 64 bytes of a buffer of arrays; each array starts at the beginning of a line. Each buffer has its own
/// type, so that they cannot be confused.
typedef struct SurfaceLine {
  uint words[16];
} SurfaceLine;
typedef struct ShadingLine {
  uint words[16];
} ShadingLine;
typedef struct LightLine {
  uint words[16];
} LightLine;
typedef struct OccluderLine {
  uint words[16];
} OccluderLine;

/// The first line of each of a scene's arrays.
typedef struct SceneLayout {
  // Surface data for rays and bounces, in SurfaceLines.
  uint triangles;  ///< DeviceTriangle [stored triangle]
  uint ranges;     ///< SurfaceRange [range], ascending; none if all of the scene's triangles are stored
  uint rangeCount;
  uint materials;   ///< DeviceMaterial [material] for the albedo
  uint textures;    ///< DeviceTexture, those of the albedo
  uint texCoords;   ///< float2 [stored vertex]
  uint texCoords1;  ///< float2 [stored vertex]
  uint colors;      ///< float4 [stored vertex]
  uint texels;      ///< ushort4
  // Additional data for path tracing, in ShadingLines.
  uint vertices;  ///< float [vertex][6] position, normal
  uint flat;      ///< uchar [stored triangle] 1 where there are no shading normals
  /// uint [triangle][corner], see transport/interaction_funcs.cl; read only with PRELIGHT_BUMPS.
  uint tangents;
  uint bases;            ///< DeviceMaterial [material] for the base colour
  uint shadeMaterials;   ///< ShadeMaterial [material]
  uint shadeTextures;    ///< DeviceTexture, those of all materials
  uint shadeTexCoords;   ///< float2 [stored vertex]
  uint shadeTexCoords1;  ///< float2 [stored vertex]
  uint shadeTexels;      ///< ushort4
  /// float4, albedos of rough lobes (transport/albedo_table_funcs.cl); read only with PRELIGHT_GLOSSY.
  uint albedos;
  /// float, tables of measured materials (transport/measured_funcs.cl); read only with PRELIGHT_MEASURED.
  uint measured;
  // Lights, in LightLines.
  uint tables;            ///< uint: lower bounds of intervals
  uint emitters;          ///< uint [emitter] triangle
  uint emitterDensities;  ///< float [triangle], or [emitter] where triangles have parts
  // Read only where triangles have parts, with PRELIGHT_EMITTER_PARTS.
  uint emitterParts;      ///< float4 [emitter] origin and scale
  uint emitterRadiances;  ///< float4 [emitter]
  uint emitterRoots;      ///< uint [triangle] reference
  uint emitterNodes;      ///< uint [node][4] references
  uint punctual;          ///< PunctualLight
  uint sky;               ///< float4 [row][column]
  uint profiles;          ///< float4, profiles of lamps; read only with PRELIGHT_PROFILES
  LightLayout lights;
  // Occluders, in OccluderLines.
  uint occluderFlags;     ///< uint [material] PRELIGHT_OCCLUDER_*
  uint occluderGroups;    ///< uint [vertex]
  uint occluderVertices;  ///< OccluderVertex [vertex]
} SceneLayout;

PRELIGHT_SHARED_END

#endif

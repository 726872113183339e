// Scene data that vector occluders need.
#ifndef PRELIGHT_VECTOR_OCCLUDERS_OCCLUDER_SCENE_FUNCS_CL
#define PRELIGHT_VECTOR_OCCLUDERS_OCCLUDER_SCENE_FUNCS_CL

#include "shared/occluder_types.h"
#include "shared/scene_layout_types.h"

// The occluders of a scene in their buffers.
typedef struct OccluderScene {
  __global const uint* flags;               // [material] PRELIGHT_OCCLUDER_*
  __global const uint* groups;              // [vertex]
  __global const OccluderVertex* vertices;  // [vertex]
} OccluderScene;

OccluderScene occludersOf(__constant const SceneLayout* layout, __global const OccluderLine* lines) {
  const OccluderScene occluders = {(__global const uint*)(lines + layout->occluderFlags),
                                   (__global const uint*)(lines + layout->occluderGroups),
                                   (__global const OccluderVertex*)(lines + layout->occluderVertices)};
  return occluders;
}

#endif

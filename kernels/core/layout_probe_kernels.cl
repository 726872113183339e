// Reports the device's layout of every shared struct, which the host compares with its own.
// Output: [struct] sizeof, then the offset of a late field, in the order of host/device/layout.cpp.

#include "shared/bvh_types.h"
#include "shared/cached_light_types.h"
#include "shared/cast_types.h"
#include "shared/density_types.h"
#include "shared/gather_types.h"
#include "shared/instance_types.h"
#include "shared/light_group_types.h"
#include "shared/occluder_light_types.h"
#include "shared/occluder_types.h"
#include "shared/photon_path_types.h"
#include "shared/photon_types.h"
#include "shared/queue_types.h"
#include "shared/radiosity_types.h"
#include "shared/ray_types.h"
#include "shared/reference_types.h"
#include "shared/scene_layout_types.h"
#include "shared/scene_types.h"
#include "shared/shade_types.h"
#include "shared/specular_types.h"
#include "shared/walk_types.h"
#include "shared/walled_square.h"

#define PROBE(index, Type, field)                         \
  out[2 * (index)] = (uint)sizeof(Type);                  \
  out[2 * (index) + 1] = (uint)(size_t)(&((Type*)0)->field)

// out: [struct][size, offset].
void probeFirstHalf(__global uint* out) {
  PROBE(0, Ray, tMax);
  PROBE(1, Hit, v);
  PROBE(2, WideNode, child);
  PROBE(3, TriangleBlock, triangle);
  PROBE(4, NarrowNode, child);
  PROBE(5, NarrowTriangle, triangle);
  PROBE(6, DeviceMaterial, flags);
  PROBE(7, DeviceTriangle, material);
  PROBE(8, SurfaceRange, vertexShift);
  PROBE(9, Receiver, firstSample);
  PROBE(10, CastParameters, firstStored);
  PROBE(11, Sender, albedo);
  PROBE(12, ReferenceParameters, scene);
  PROBE(13, ShadeMaterial, textures);
  PROBE(14, PunctualLight, coneOffset);
  PROBE(15, PathState, seesWalls);
  PROBE(16, OccluderVertex, accessibility);
  PROBE(17, OccluderSums, group);
  PROBE(18, OccluderWay, ray);
  PROBE(19, OccluderWaySums, pad);
  PROBE(20, GlassPath, medium);
  PROBE(21, OccluderLight, twoSided);
  PROBE(22, OccluderReceiverPoint, pad1);
  PROBE(23, LitVertex, pad1);
  PROBE(24, OccluderTerms, eyeZ);
  PROBE(25, Photon, direction);
  PROBE(26, LeafTree, count);
  PROBE(27, PhotonBlock, direction);
  PROBE(28, AreaNode, triangleCount);
  PROBE(29, AreaTriangle, normal);
  PROBE(30, DensityParameters, photonBlocks);
}

void probeSecondHalf(__global uint* out) {
  PROBE(31, DensityQuery, patch);
  PROBE(32, PhotonSource, tangent);
  PROBE(33, PhotonParameters, scene);
  PROBE(34, PhotonPath, mirrored);
  PROBE(35, GatherParameters, scene);
  PROBE(36, GatherPath, behind);
  PROBE(37, PhotonGrid, firstCell);
  PROBE(38, DeviceInstance, triangleCount);
  PROBE(39, LightRay, sampleCount);
  PROBE(40, GroupEmitter, factor);
  PROBE(41, LightLayout, skyTurn);
  PROBE(42, ElementPoint, back);
  PROBE(43, EmitterRange, table);
  PROBE(44, VirtualLight, through);
  PROBE(45, SurfacePlace, clearance);
  PROBE(46, SurfaceLine, words);
  PROBE(47, ShadingLine, words);
  PROBE(48, LightLine, words);
  PROBE(49, OccluderLine, words);
  PROBE(50, SceneLayout, occluderVertices);
  PROBE(51, PathStep, goesOn);
  PROBE(52, PhotonStep, next);
  PROBE(53, IrradianceLine, words);
  PROBE(54, IrradianceMapLayout, walled);
  PROBE(55, GatherStep, next);
  PROBE(56, DensityLine, words);
  PROBE(57, CachedPathParameters, causticSamples);
  PROBE(58, GlassStep, reach);
  PROBE(59, DirectRays, skySamples);
  PROBE(60, RelaxStep, perSide);
  PROBE(61, LightGroupLine, words);
  PROBE(62, LightGroupLayout, emitters);
  PROBE(63, QueueMove, to);
  PROBE(64, DeviceTexture, wrapT);
  PROBE(65, GatherArrival, ray);
  PROBE(66, SpecularStep, next);
  PROBE(67, SpecularPath, dispersed);
  PROBE(68, SpecularEnd, v);
  PROBE(69, GatherRecord, nearest);
  PROBE(70, MediumWalk, steps);
  PROBE(71, SourceCell, copy);
  PROBE(72, Eye, forward);
  PROBE(73, ImportanceGrid, side);
  PROBE(74, PathParts, arriving);
  PROBE(75, WalledSquare, right);
  PROBE(76, SquareWeights, rightBottom);
}

// One work-item. out: [struct][size, offset].
__kernel void probeLayout(__global uint* out) {
  if (get_global_id(0) != 0) return;
  probeFirstHalf(out);
  probeSecondHalf(out);
}

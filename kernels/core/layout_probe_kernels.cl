// Asks the device for the layout of every shared struct; the host compares it with its own.
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
#include "shared/radiosity_types.h"
#include "shared/ray_types.h"
#include "shared/reference_types.h"
#include "shared/scene_layout_types.h"
#include "shared/scene_types.h"
#include "shared/shade_types.h"

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
  PROBE(6, DeviceMaterial, wrapT);
  PROBE(7, DeviceTriangle, material);
  PROBE(8, SurfaceRange, vertexShift);
  PROBE(9, Receiver, firstSample);
  PROBE(10, CastParameters, firstStored);
  PROBE(11, Sender, albedo);
  PROBE(12, ReferenceParameters, scene);
  PROBE(13, ShadeMaterial, flags);
  PROBE(14, PunctualLight, coneOffset);
  PROBE(15, PathState, diffuseBounces);
  PROBE(16, ShadowItem, path);
  PROBE(17, OccluderVertex, accessibility);
  PROBE(18, OccluderSums, group);
  PROBE(19, OccluderWay, ray);
  PROBE(20, OccluderWaySums, pad);
  PROBE(21, GlassPath, medium);
  PROBE(22, OccluderLight, twoSided);
  PROBE(23, OccluderReceiverPoint, pad1);
  PROBE(24, LitVertex, pad1);
  PROBE(25, OccluderTerms, eyeZ);
  PROBE(26, Photon, direction);
  PROBE(27, LeafTree, count);
  PROBE(28, PhotonBlock, direction);
  PROBE(29, AreaNode, triangleCount);
  PROBE(30, AreaTriangle, normal);
  PROBE(31, DensityParameters, photonBlocks);
}

void probeSecondHalf(__global uint* out) {
  PROBE(32, DensityQuery, radius);
  PROBE(33, PhotonSource, tangent);
  PROBE(34, PhotonParameters, scene);
  PROBE(35, PhotonPath, mirrored);
  PROBE(36, GatherParameters, scene);
  PROBE(37, GatherPath, widened);
  PROBE(38, PhotonGrid, firstCell);
  PROBE(39, DeviceInstance, triangleCount);
  PROBE(40, LightRay, sampleCount);
  PROBE(41, GroupEmitter, factor);
  PROBE(42, LightLayout, skyTurn);
  PROBE(43, ElementPoint, back);
  PROBE(44, EmitterRange, table);
  PROBE(45, VirtualLight, through);
  PROBE(46, SurfacePlace, clearance);
  PROBE(47, SurfaceLine, words);
  PROBE(48, ShadingLine, words);
  PROBE(49, LightLine, words);
  PROBE(50, OccluderLine, words);
  PROBE(51, SceneLayout, occluderVertices);
  PROBE(52, PathStep, goesOn);
  PROBE(53, PhotonStep, next);
  PROBE(54, IrradianceLine, words);
  PROBE(55, IrradianceMapLayout, triangleCount);
  PROBE(56, GatherStep, next);
  PROBE(57, DensityLine, words);
  PROBE(58, CachedPathParameters, causticSamples);
  PROBE(59, GlassStep, reach);
  PROBE(60, DirectRays, skySamples);
  PROBE(61, RelaxStep, perSide);
  PROBE(62, LightGroupLine, words);
  PROBE(63, LightGroupLayout, emitters);
}

// One work-item.
__kernel void probeLayout(__global uint* out) {
  if (get_global_id(0) != 0) return;
  probeFirstHalf(out);
  probeSecondHalf(out);
}

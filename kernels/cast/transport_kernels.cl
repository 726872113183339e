// Stored transport: what each receiver's rays hit, kept so that bounces need no new rays.
#include "transport/alpha_funcs.cl"
#include "core/prefetch_funcs.cl"
#include "core/sampling_funcs.cl"
#include "project/visibility_funcs.cl"
#include "shared/cast_types.h"
#include "shared/ray_types.h"
#include "shared/specular_types.h"

// Options: PRELIGHT_COLUMNS, values per channel of the transfer; PRELIGHT_GLOSSY_ORDER, order of transfer matrices;
// PRELIGHT_TRANSLUCENT, a material lets light through diffusely; PRELIGHT_FOLLOWED, rays go on from mirrors and glass.
#ifndef PRELIGHT_COLUMNS
#define PRELIGHT_COLUMNS 1
#endif

// PRELIGHT_PART_VALUES, 8 or 16: values of a vertex's transfer that one launch of a bounce processes.
#ifndef PRELIGHT_PART_VALUES
#define PRELIGHT_PART_VALUES 16
#endif
#if PRELIGHT_PART_VALUES == 16
typedef float16 Part;
typedef uint16 PartIndex;
#define PRELIGHT_PART_OF(name) name##16
#define PRELIGHT_PART_NUMBERS (uint16)(0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 9u, 10u, 11u, 12u, 13u, 14u, 15u)
#else
typedef float8 Part;
typedef uint8 PartIndex;
#define PRELIGHT_PART_OF(name) name##8
#define PRELIGHT_PART_NUMBERS (uint8)(0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u)
#endif

// Number of rays ahead of the current one whose triangle is prefetched, because triangles are read in random order.
#define PRELIGHT_RAYS_AHEAD 24

#ifdef PRELIGHT_GLOSSY_ORDER
#define PRELIGHT_SH_ORDER PRELIGHT_GLOSSY_ORDER
#include "project/sh_funcs.cl"
#endif

// Returns the quantisation step of a sender's albedo. A surface seen from within glass may appear brighter by the
// square of the glass's index of refraction: two bits of the albedo hold how often it is doubled.
float albedoStep(Sender s) {
#ifdef PRELIGHT_FOLLOWED
  return (float)(1u << (s.albedo >> 30)) * (1.0f / 1023.0f);
#else
  return 1.0f / 1023.0f;
#endif
}

// Returns the sender's albedo in channel c: 0 red, 1 green, 2 blue.
float senderAlbedo(Sender s, uint c) { return (float)((s.albedo >> (10 * c)) & 1023u) * albedoStep(s); }

// Returns a number in [0,1) for a decision about a ray; repeated calls return the same number.
float pickOf(__global const Receiver* r, uint sample, uint decision) {
  return (float)(hashInteger(sample ^ hashInteger(r->seed ^ decision)) >> 8) * 5.9604644775390625e-8f;
}

#ifdef PRELIGHT_TRANSLUCENT
// Light that leaves a translucent surface is albedo x transfer of the visible side + transmission x transfer of the
// other side. One of the two is chosen in proportion to its largest channel and divided by its probability. The mean is
// unchanged, and as the largest channels add up to at most 1, the resulting albedo is at most 1 too. Returns true when
// the other side is chosen.
bool pickTransmission(Surface s, uint triangle, float blocked, float pick, float3* albedo) {
  const uint bits = s.materials[materialAt(s, triangle)].transmission;
  if (bits == 0u) return false;
  const float3 through =
      blocked * (1.0f / 1023.0f) *
      (float3)((float)(bits & 1023u), (float)(bits >> 10 & 1023u), (float)(bits >> 20 & 1023u));
  const float reflected = fmax(albedo->x, fmax(albedo->y, albedo->z));
  const float transmitted = fmax(through.x, fmax(through.y, through.z)), both = reflected + transmitted;
  const bool passes = pick * both < transmitted;
  if (both > 0.0f) *albedo = passes ? through * (both / transmitted) : *albedo * (both / reflected);
  return passes;
}
#endif

// Prefetches the data of a triangle that storeSenders() reads.
PRELIGHT_INLINE void askForTriangle(Surface surface, __global const float* geometricNormals, uint triangle) {
#if defined(PRELIGHT_PREFETCH) && !defined(PRELIGHT_SHARED_SURFACE)
  if (triangle == PRELIGHT_NO_TRIANGLE) return;
  prefetchBytes((__global const char*)(surface.triangles + triangle), sizeof(DeviceTriangle));
  prefetchBytes((__global const char*)(geometricNormals + 3 * (size_t)triangle), sizeof(float));
#endif
}

// Returns the sender for a receiver's ray: a vertex of the triangle that was hit and the `albedo` by which its transfer
// is multiplied. `passes` takes the side that the ray does not see. The transfer at the hit is interpolated from three
// vertices; choosing one vertex with its barycentric weight as probability has the same mean and a third of the reads.
Sender senderAt(__constant const CastParameters* parameters, Surface surface, __global const float* geometricNormals,
                float3 direction, Hit hit, float3 albedo, bool passes, float pick, __global uchar* marks) {
  Sender sender = {PRELIGHT_NO_TRIANGLE, 0u};
  uint doubled = 0u;
#ifdef PRELIGHT_FOLLOWED
  for (; doubled < 3u && fmax(albedo.x, fmax(albedo.y, albedo.z)) > 1.0f; ++doubled) albedo *= 0.5f;
#endif
  const uint3 packed = min(convert_uint3_rte(albedo * 1023.0f), 1023u);
  const uint bits = packed.x | (packed.y << 10) | (packed.z << 20);
  if (bits == 0u) return sender;
  const uint corner = pick < hit.u ? 1u : (pick < hit.u + hit.v ? 2u : 0u);
  const bool back = (dot(direction, vload3(hit.triangle, geometricNormals)) > 0.0f) != passes;
  if (back) marks[hit.triangle] = 1;
  sender.vertex = triangleAt(surface, hit.triangle).vertex[corner] + (back ? parameters->vertexCount : 0u);
  sender.albedo = bits | doubled << 30;
  return sender;
}

// Returns the sender at a diffuse surface of which `share` of the outgoing light arrives at the receiver.
Sender diffuseSender(__constant const CastParameters* parameters, Surface surface, __global const float* geometricNormals,
                     __global const Receiver* receivers, size_t ray, float3 direction, Hit hit, float3 share,
                     __global uchar* marks) {
  const float blocked = 1.0f - visibilityOf(parameters, hit);
  float3 albedo = blocked * clamp(surfaceColor(surface, hit.triangle, hit.u, hit.v).xyz, 0.0f, 1.0f);
  __global const Receiver* r = receivers + ray / parameters->raysPerReceiver;
  const uint sample = r->firstSample + (uint)(ray % parameters->raysPerReceiver);
  bool passes = false;
#ifdef PRELIGHT_TRANSLUCENT
  passes = pickTransmission(surface, hit.triangle, blocked, pickOf(r, sample, 0x27d4eb2fu), &albedo);
#endif
  const float pick = pickOf(r, sample, 0x5bd1e995u);
  return senderAt(parameters, surface, geometricNormals, direction, hit, share * albedo, passes, pick, marks);
}

// One work-item per ray. rays, hits [receiver][raysPerReceiver] -> senders, of that shape, rows from firstStored on;
// marks [triangle] is set to 1 where the transfer of a back is needed, because it reflects to a receiver or lets light
// through to the front. Next: gatherBounce.
__kernel void storeSenders(__constant const CastParameters* parameters, __constant const SceneLayout* layout,
                           __global const SurfaceLine* surfaceLines, __global const float* geometricNormals,
                           __global const Receiver* receivers, __global const Ray* rays, __global const Hit* hits,
                           __global Sender* senders, __global uchar* marks) {
  const size_t i = get_global_id(0), count = (size_t)parameters->receiverCount * parameters->raysPerReceiver;
  if (i >= count) return;
  const Surface surface = surfaceOf(layout, surfaceLines);
  askForTriangle(surface, geometricNormals, hits[min(i + PRELIGHT_RAYS_AHEAD, count - 1)].triangle);
  const Hit hit = hits[i];
  Sender sender = {PRELIGHT_NO_TRIANGLE, 0u};
  if (hit.triangle != PRELIGHT_NO_TRIANGLE)
    sender = diffuseSender(parameters, surface, geometricNormals, receivers, i, vload3(0, rays[i].direction), hit,
                           (float3)(1.0f), marks);
  senders[(size_t)parameters->firstStored * parameters->raysPerReceiver + i] = sender;
}

#ifdef PRELIGHT_FOLLOWED
// One work-item per ray, after storeSenders. ends [receiver][raysPerReceiver] of cast/specular_kernels.cl -> the
// senders of the rays that went on. Next: gatherBounce.
__kernel void storeFollowed(__constant const CastParameters* parameters, __constant const SceneLayout* layout,
                            __global const SurfaceLine* surfaceLines, __global const float* geometricNormals,
                            __global const Receiver* receivers, __global const SpecularEnd* ends,
                            __global Sender* senders, __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= (size_t)parameters->receiverCount * parameters->raysPerReceiver) return;
  if (ends[i].kind == PRELIGHT_SPECULAR_MET_NONE) return;
  const SpecularEnd end = ends[i];
  const Surface surface = surfaceOf(layout, surfaceLines);
  const Hit hit = {0.0f, end.triangle, end.u, end.v};
  const float3 share = vload3(0, end.throughput), direction = vload3(0, end.direction);
  Sender sender = {PRELIGHT_NO_TRIANGLE, 0u};
  if (end.kind == PRELIGHT_SPECULAR_SURFACE) {
    sender = diffuseSender(parameters, surface, geometricNormals, receivers, i, direction, hit, share, marks);
  } else if (end.kind == PRELIGHT_SPECULAR_BODY || end.kind == PRELIGHT_SPECULAR_THROUGH) {
    __global const Receiver* r = receivers + i / parameters->raysPerReceiver;
    const float pick = pickOf(r, r->firstSample + (uint)(i % parameters->raysPerReceiver), 0x5bd1e995u);
    sender = senderAt(parameters, surface, geometricNormals, direction, hit, share,
                      end.kind == PRELIGHT_SPECULAR_THROUGH, pick, marks);
  }
  senders[(size_t)parameters->firstStored * parameters->raysPerReceiver + i] = sender;
}
#endif

// One work-item per receiver. A vertex's transfer has values [3][PRELIGHT_COLUMNS], of which the launch processes the
// part from firstValue on. senders [firstStored + receiver][raysPerReceiver], transfer [firstPlace +
// vertex][PRELIGHT_PART_VALUES] of the previous bounce -> values [receiver][PRELIGHT_PART_VALUES], the mean over the
// receiver's rays of albedo x transfer.
__kernel void gatherBounce(__constant const CastParameters* parameters, uint firstValue, uint firstPlace,
                           __global const Sender* senders, __global const float* transfer, __global float* values) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  const PartIndex value = firstValue + PRELIGHT_PART_NUMBERS;
  const PartIndex shift = 10u * min(value / PRELIGHT_COLUMNS, 2u);
  senders += ((size_t)parameters->firstStored + receiver) * parameters->raysPerReceiver;
  Part sum = 0.0f;
  for (uint j = 0; j < parameters->raysPerReceiver; ++j) {
    const Sender s = senders[j];
    if (s.vertex == PRELIGHT_NO_TRIANGLE) continue;
    const Part albedo = PRELIGHT_PART_OF(convert_float)(((PartIndex)s.albedo >> shift) & 1023u) * albedoStep(s);
    sum += albedo * PRELIGHT_PART_OF(vload)((size_t)firstPlace + s.vertex, transfer);
  }
  PRELIGHT_PART_OF(vstore)(sum * (1.0f / (float)parameters->raysPerReceiver), receiver, values);
}

#ifdef PRELIGHT_GLOSSY_ORDER
// One work-item per receiver. senders as in gatherBounce; rays [receiver][raysPerReceiver] that met them; transfer
// [vertex][3][PRELIGHT_COLUMNS], a part of the light's coefficients -> values [receiver][i][3][PRELIGHT_COLUMNS] with i
// below PRELIGHT_GLOSSY_ORDER^2: the mean over rays of Y_i(direction) x albedo x transfer. shTable as in sh_funcs.cl.
__kernel void gatherGlossy(__constant const CastParameters* parameters, __constant const float* shTable,
                           __global const Ray* rays, __global const Sender* senders,
                           __global const float* transfer, __global float* values) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  const uint rows = PRELIGHT_GLOSSY_ORDER * PRELIGHT_GLOSSY_ORDER, width = 3 * PRELIGHT_COLUMNS;
  values += receiver * rows * width;
  for (uint i = 0; i < rows * width; ++i) values[i] = 0.0f;
  const float scale = 1.0f / (float)parameters->raysPerReceiver;
  for (uint j = 0; j < parameters->raysPerReceiver; ++j) {
    const Sender s = senders[((size_t)parameters->firstStored + receiver) * parameters->raysPerReceiver + j];
    if (s.vertex == PRELIGHT_NO_TRIANGLE) continue;
    __global const float* t = transfer + (size_t)s.vertex * width;
    float sent[3 * PRELIGHT_COLUMNS];
    for (uint c = 0; c < 3; ++c)
      for (uint k = 0; k < PRELIGHT_COLUMNS; ++k)
        sent[c * PRELIGHT_COLUMNS + k] = scale * senderAlbedo(s, c) * t[c * PRELIGHT_COLUMNS + k];
    float basis[PRELIGHT_GLOSSY_ORDER * PRELIGHT_GLOSSY_ORDER];
    evaluateSh(shTable, vload3(0, rays[receiver * parameters->raysPerReceiver + j].direction), basis);
    for (uint i = 0; i < rows; ++i)
      for (uint k = 0; k < width; ++k) values[i * width + k] += basis[i] * sent[k];
  }
}
#endif

// Rows of stored transport: what each receiver's rays hit, kept so that bounces need no new rays.
#include "transport/alpha_funcs.cl"
#include "core/prefetch_funcs.cl"
#include "core/sampling_funcs.cl"
#include "project/visibility_funcs.cl"
#include "shared/cast_types.h"
#include "shared/ray_types.h"
#include "shared/specular_types.h"

// Options: PRELIGHT_COLUMNS, values a channel of the transfer; PRELIGHT_GLOSSY_ORDER, of transfer matrices;
// PRELIGHT_TRANSLUCENT, when a material lets light through diffusely; PRELIGHT_FOLLOWED, when rays go on from mirrors and glass.
#ifndef PRELIGHT_COLUMNS
#define PRELIGHT_COLUMNS 1
#endif

// PRELIGHT_PART_VALUES, 8 or 16: values of a vertex's transfer that a bounce carries at once.
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

// Rays ahead of the one at hand whose triangle is asked for: it lies anywhere in memory.
#define PRELIGHT_RAYS_AHEAD 24

#ifdef PRELIGHT_GLOSSY_ORDER
#define PRELIGHT_SH_ORDER PRELIGHT_GLOSSY_ORDER
#include "project/sh_funcs.cl"
#endif

// One step of a sender's albedo. What is seen from within glass may be brighter by the square of its index of refraction:
// two bits of the albedo say how often it is doubled.
float albedoStep(Sender s) {
#ifdef PRELIGHT_FOLLOWED
  return (float)(1u << (s.albedo >> 30)) * (1.0f / 1023.0f);
#else
  return 1.0f / 1023.0f;
#endif
}

// The sender's albedo in channel c: 0 red, 1 green, 2 blue.
float senderAlbedo(Sender s, uint c) { return (float)((s.albedo >> (10 * c)) & 1023u) * albedoStep(s); }

// A number in [0,1) for a decision about a ray, the same whenever it is asked for.
float pickOf(__global const Receiver* r, uint sample, uint decision) {
  return (float)(hashInteger(sample ^ hashInteger(r->seed ^ decision)) >> 8) * 5.9604644775390625e-8f;
}

#ifdef PRELIGHT_TRANSLUCENT
// What leaves a translucent surface is albedo x transfer of the side that is seen + transmission x transfer of the other:
// one of the two stands for both, chosen in proportion to its largest channel and divided by its probability. The mean
// stays, and as their largest channels add up to at most 1, so does what stands for both. True: the other side.
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

// Asks for what storeSenders() reads of a triangle.
PRELIGHT_INLINE void askForTriangle(Surface surface, __global const float* geometricNormals, uint triangle) {
#if defined(PRELIGHT_PREFETCH) && !defined(PRELIGHT_SHARED_SURFACE)
  if (triangle == PRELIGHT_NO_TRIANGLE) return;
  prefetchBytes((__global const char*)(surface.triangles + triangle), sizeof(DeviceTriangle));
  prefetchBytes((__global const char*)(geometricNormals + 3 * (size_t)triangle), sizeof(float));
#endif
}

// What a receiver's ray brings from where it ends: `albedo` of the transfer there, on the other side than the seen one if it
// `passes` through. The hit's value will be interpolated from three vertices: taking one of them with its barycentric weight as
// probability has the same mean and a third of the reads.
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

// The same of a surface that is diffuse, where `share` of what it sends arrives.
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

// A ray a work-item. rays, hits [receiver][raysPerReceiver] -> senders, same shape, rows from firstStored on; marks
// [triangle] is set to 1 where the transfer of a back is needed: it reflects to the receiver, or lets light through to the
// front. Next: gatherBounce.
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
// A ray a work-item, after storeSenders. ends [receiver][raysPerReceiver], of cast/specular_kernels.cl -> the senders of
// those that went on. Next: gatherBounce.
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

// A receiver a work-item. Of the values [3][PRELIGHT_COLUMNS] that light's transfer has a vertex, the part from firstValue
// on: senders [firstStored + receiver][raysPerReceiver], transfer [firstPlace + vertex][PRELIGHT_PART_VALUES] of the
// previous bounce -> values [receiver][PRELIGHT_PART_VALUES], the mean over the receiver's rays of albedo x transfer.
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
// A receiver a work-item. senders as above; rays [receiver][raysPerReceiver], those that met them; transfer
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

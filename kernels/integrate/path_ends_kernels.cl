// Start and end of camera paths, shared by all path integrators.
// Options: PRELIGHT_LENS: the camera has a thin lens instead of a pinhole.
#ifndef PRELIGHT_REFERENCE_PATH_ENDS_CL
#define PRELIGHT_REFERENCE_PATH_ENDS_CL

#include "core/shadow_share_funcs.cl"
#include "integrate/path_funcs.cl"
#include "integrate/path_parts_funcs.cl"

#ifdef PRELIGHT_LENS
// Returns the point of the lens through which a path leaves, relative to the eye. Points are even on the lens.
PRELIGHT_INLINE float3 lensPoint(__constant const ReferenceParameters* p, uint path) {
  const float2 u = pathPoint(p, path, PRELIGHT_PAIR_LENS);
  const float radius = p->lensRadius * sqrt(u.x), angle = 2.0f * M_PI_F * u.y;
  return radius * (cos(angle) * normalize(vload3(0, p->right)) + sin(angle) * normalize(vload3(0, p->up)));
}
#endif

// One work-item per path. -> paths, rays [pathCount], and numbers [pathCount], the path of each ray.
__kernel void generatePaths(__constant const ReferenceParameters* p, __global PathState* paths, __global uint* numbers,
                            __global Ray* rays) {
  const size_t i = get_global_id(0);
  if (i >= p->pathCount) return;
  const uint pixel = p->firstPixel + (uint)i / p->samplesPerPass;
  const float2 jitter = pathPoint(p, (uint)i, PRELIGHT_PAIR_PIXEL);
  const float x = 2.0f * ((float)(pixel % p->width) + jitter.x) / (float)p->width - 1.0f;
  const float y = 1.0f - 2.0f * ((float)(pixel / p->width) + jitter.y) / (float)p->height;
  const float3 forward = vload3(0, p->forward), across = x * vload3(0, p->right) + y * vload3(0, p->up);
  const bool perspective = p->perspective != 0u;
  float3 way = perspective ? forward + across : forward;  // by a metre of depth
  float3 aside = perspective ? (float3)(0.0f) : across;
#ifdef PRELIGHT_LENS
  // The rays of a point of the picture meet in the plane in focus (Cook, Porter and Carpenter 1984).
  const float3 onLens = lensPoint(p, (uint)i);
  aside += onLens;
  way -= onLens / p->focus;
#endif
  const float stretch = length(way);  // metres along the ray per metre of depth
  Ray ray;
  vstore3(vload3(0, p->eye) + way * p->zNear + aside, 0, ray.origin);
  vstore3(way / stretch, 0, ray.direction);
  ray.sourceTriangle = PRELIGHT_NO_TRIANGLE;
  ray.tMax = p->zFar < MAXFLOAT ? (p->zFar - p->zNear) * stretch : MAXFLOAT;
  rays[i] = ray;
  numbers[i] = (uint)i;
  PathState path = {{1.0f, 1.0f, 1.0f}, 0.0f, {0.0f, 0.0f, 0.0f}, 1.0f, PRELIGHT_NO_MEDIUM, 0u, {0.0f, 0.0f, 0.0f}, 0u, 0.0f, 0, 0, 0};
  paths[i] = path;
  beginParts(p, paths, (uint)i);
}

// One work-item per shadow ray, in the order of lists from firstListed on; a path has at most one. hits [count];
// numbers: the paths of the step's rays; parts: as in ReferenceParameters.
__kernel void addArrivals(const uint count, const uint firstListed, __global const uint* lists, __global const Hit* hits,
                          __global const uint* numbers, __global PathState* paths, const uint parts) {
  const size_t i = get_global_id(0);
  if (i >= count || !lightArrives(hits[i])) return;
  const uint number = numbers[lists[firstListed + i]];
  __global PathState* path = paths + number;
  const float3 arriving = shadowShare(hits[i]) * vload3(0, path->arriving);
  vstore3(vload3(0, path->radiance) + arriving, 0, path->radiance);
  if (parts != 0u) keepPart(parts, paths, number, partsOf(parts, paths, number)->arriving, arriving);
}

// Returns the mean of n vectors that are `stride` floats apart. The summation is compensated (Neumaier).
PRELIGHT_INLINE float3 meanOf(__global const float* vectors, uint stride, uint n) {
#pragma OPENCL FP_CONTRACT OFF
  float3 sum = (float3)(0.0f), lost = (float3)(0.0f);
  for (uint s = 0; s < n; ++s) {
    const float3 term = vload3(0, vectors + (size_t)s * stride);
    const float3 next = sum + term;
    lost += select((term - next) + sum, (sum - next) + term, fabs(sum) >= fabs(term));
    sum = next;
  }
  return (sum + lost) / (float)n;
}

#define PRELIGHT_PATH_FLOATS ((uint)(sizeof(PathState) / sizeof(float)))

// One work-item per pixel of the block. paths [pixel][samplesPerPass] -> means [pixel], w unused.
__kernel void averageSamples(__constant const ReferenceParameters* p, __global const PathState* paths,
                             __global float4* means) {
  const size_t i = get_global_id(0);
  const uint n = p->samplesPerPass;
  if (i >= p->pathCount / n) return;
  means[i] = (float4)(meanOf(paths[i * n].radiance, PRELIGHT_PATH_FLOATS, n), 0.0f);
}

// One work-item per part and pixel of the block. The paths' parts [pixel][samplesPerPass] -> means [part][pixel], w
// unused.
__kernel void averageParts(__constant const ReferenceParameters* p, __global PathState* paths, __global float4* means) {
  const size_t i = get_global_id(0);
  const uint n = p->samplesPerPass, pixels = p->pathCount / n;
  if (i >= PRELIGHT_PARTS * pixels) return;
  const uint part = (uint)i / pixels, pixel = (uint)i % pixels;
  means[i] = (float4)(meanOf(partsOf(p->parts, paths, pixel * n)->light[part], PRELIGHT_PATH_FLOATS, n), 0.0f);
}

#endif

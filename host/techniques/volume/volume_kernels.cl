// Voxels of a grid in the air, which receive light from all directions.
// Options: PRELIGHT_SH_ORDER; PRELIGHT_COLUMNS, values per channel of the surfaces' transfer; PRELIGHT_SENT_ORDER, SH
// bands by direction of the light that surfaces send to a voxel.
#include "transport/alpha_funcs.cl"
#include "core/lanes_funcs.cl"
#include "core/sampling_block_funcs.cl"
#include "project/sh_funcs.cl"
#include "project/visibility_funcs.cl"
#include "shared/cast_types.h"
#include "shared/ray_types.h"

#ifndef PRELIGHT_COLUMNS
#define PRELIGHT_COLUMNS 1
#endif
#ifndef PRELIGHT_SENT_ORDER
#define PRELIGHT_SENT_ORDER 1
#endif
#define PRELIGHT_SENT_BANDS (PRELIGHT_SENT_ORDER * PRELIGHT_SENT_ORDER)

// One work-item per eight rays of a voxel; an aligned run of them fills a compact patch of the sphere. lowerAndCell:
// the grid's lower corner and the side of a cell, m; sizeAndFirst: cells along x, y, z and the first voxel of the block
// -> rays [voxel][raysPerReceiver], uniform over the sphere. Each voxel has its own sequence. Next: traceRays.
__kernel void generateVolumeRays(__constant const CastParameters* parameters, float4 lowerAndCell, uint4 sizeAndFirst,
                                 uint seed, __global Ray* rays) {
  const size_t i = get_global_id(0);
  const uint count = parameters->raysPerReceiver;
  if (i >= (size_t)parameters->receiverCount * (count / 8)) return;
  const uint voxel = sizeAndFirst.w + (uint)(i / (count / 8));
  const float3 cell = (float3)((float)(voxel % sizeAndFirst.x), (float)(voxel / sizeAndFirst.x % sizeAndFirst.y),
                               (float)(voxel / (sizeAndFirst.x * sizeAndFirst.y)));
  const float3 centre = lowerAndCell.xyz + lowerAndCell.w * (cell + 0.5f);

  // Blocks have at most 256 points, the most that sobolIndexInCell8 can order.
  const uint block = min(count, 256u), first = (uint)(i % (count / 8)) * 8;
  const uint scramble = hashInteger(voxel ^ hashInteger(seed));
  const uint8 index = sobolIndexInCell8(first % block + (uint8)(0, 1, 2, 3, 4, 5, 6, 7), 31 - clz(block),
                                        first - first % block, scramble);
  float8 u, v;
  sampleSobol8(index, scramble, &u, &v);
  const float8 z = 1.0f - 2.0f * u, radius = sqrt(fmax(1.0f - z * z, 0.0f)), turn = 2.0f * v;
  float directions[3][8];
  vstore8(radius * cospi(turn), 0, directions[0]);
  vstore8(radius * sinpi(turn), 0, directions[1]);
  vstore8(z, 0, directions[2]);
  const float near = parameters->nearLimit;
  rays += i * 8;
  for (int k = 0; k < 8; ++k) {
    const float3 d = (float3)(directions[0][k], directions[1][k], directions[2][k]);
    Ray ray;
    vstore3(centre + near * d, 0, ray.origin);
    vstore3(d, 0, ray.direction);
    ray.sourceTriangle = PRELIGHT_NO_TRIANGLE;
    ray.tMax = parameters->farLimit > 0.0f ? parameters->farLimit - near : MAXFLOAT;
    rays[k] = ray;
  }
}

// One work-item per voxel. rays, hits [voxel][raysPerReceiver]; geometricNormals [triangle][3]; twoSided [triangle], 1
// where both sides are fronts -> values [voxel][1 + PRELIGHT_SH_ORDER^2]: first 1 when every ray met a back, then (1/(4
// pi)) integral V Y_i dw. As in projectHits, k times the closed form of the open sphere is added to the mean of (V - k)
// Y_i, where k is the open fraction.
__kernel void projectVolume(__constant const CastParameters* parameters, __constant const float* shTable,
                            __global const Ray* rays, __global const Hit* hits, __global const float* geometricNormals,
                            __global const uchar* twoSided, __global float* values) {
  const size_t voxel = get_global_id(0);
  if (voxel >= parameters->receiverCount) return;
  const uint count = parameters->raysPerReceiver;
  rays += voxel * count;
  hits += voxel * count;
  values += voxel * (1 + PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER);
  float open = 0.0f;
  bool inside = true;
  for (uint j = 0; j < count; ++j) {
    open += visibilityOf(parameters, hits[j]);
    const uint t = hits[j].triangle;
    inside = inside && t != PRELIGHT_NO_TRIANGLE && !twoSided[t] &&
             dot(vload3(0, rays[j].direction), vload3(t, geometricNormals)) > 0.0f;
  }
  const float k = open / (float)count;
  float8 sum[PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER];
  for (int i = 0; i < PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER; ++i) sum[i] = 0.0f;
  const bool mixed = open > 0.0f && open < (float)count;
  for (uint j = 0; mixed && j < count; j += 8) {
    float weights[8];
    for (int i = 0; i < 8; ++i) weights[i] = visibilityOf(parameters, hits[j + i]) - k;
    accumulateRays(shTable, rays + j, weights, sum);
  }
  values[0] = inside ? 1.0f : 0.0f;
  for (int i = 0; i < PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER; ++i) values[1 + i] = sumOf(sum[i]) / (float)count;
  values[1] += 0.28209479177387814f * k;  // Y_00 = 1 / sqrt(4 pi), the only function whose mean is not 0
}

// Adds factor x transfer of one side of a triangle, interpolated at the hit, to sum [3][PRELIGHT_COLUMNS].
void addSide(__constant const CastParameters* parameters, __global const float* transfer, DeviceTriangle triangle,
             bool back, Hit hit, float3 factor, float* sum) {
  const float weight[3] = {1.0f - hit.u - hit.v, hit.u, hit.v}, factors[3] = {factor.x, factor.y, factor.z};
  for (uint corner = 0; corner < 3; ++corner) {
    const uint vertex = triangle.vertex[corner] + (back ? parameters->vertexCount : 0u);
    __global const float* t = transfer + (size_t)vertex * 3 * PRELIGHT_COLUMNS;
    for (uint c = 0; c < 3; ++c)
      for (uint i = 0; i < PRELIGHT_COLUMNS; ++i)
        sum[c * PRELIGHT_COLUMNS + i] += weight[corner] * factors[c] * t[c * PRELIGHT_COLUMNS + i];
  }
}

// Writes to sent [3][PRELIGHT_COLUMNS] the transfer that arrives along a ray: albedo x transfer at the hit, and what
// passes through the surface.
void gatherHit(__constant const CastParameters* parameters, Surface surface, __global const float* geometricNormals,
               __global const float* transfer, uint backs, float3 direction, Hit hit, float* sent) {
  const bool back = dot(direction, vload3(hit.triangle, geometricNormals)) > 0.0f;
  const float3 color = clamp(surfaceColor(surface, hit.triangle, hit.u, hit.v).xyz, 0.0f, 1.0f);
  const float3 albedo = (1.0f - visibilityOf(parameters, hit)) * color;
  const DeviceTriangle triangle = triangleAt(surface, hit.triangle);
  if (!back || backs != 0) addSide(parameters, transfer, triangle, back, hit, albedo, sent);
  // A translucent surface also lets through what arrives on its other side.
  const uint bits = surface.materials[triangle.material].transmission;
  if (bits == 0u || (!back && backs == 0)) return;
  const float3 through = (float3)((float)(bits & 1023u), (float)(bits >> 10 & 1023u), (float)(bits >> 20 & 1023u));
  addSide(parameters, transfer, triangle, !back, hit,
          (1.0f - visibilityOf(parameters, hit)) * (1.0f / 1023.0f) * through, sent);
}

// Writes Y_j of the first three bands, index l(l+1)+m.
void lowBands(float3 w, float* values) {
  values[0] = 0.28209479177387814f;
#if PRELIGHT_SENT_ORDER > 1
  values[1] = 0.48860251190291992f * w.y;
  values[2] = 0.48860251190291992f * w.z;
  values[3] = 0.48860251190291992f * w.x;
#endif
#if PRELIGHT_SENT_ORDER > 2
  values[4] = 1.0925484305920792f * w.x * w.y;
  values[5] = 1.0925484305920792f * w.y * w.z;
  values[6] = 0.31539156525252005f * (3.0f * w.z * w.z - 1.0f);
  values[7] = 1.0925484305920792f * w.z * w.x;
  values[8] = 0.54627421529603959f * (w.x * w.x - w.y * w.y);
#endif
}

// One work-item per voxel. rays, hits as in projectVolume; transfer [vertex][3][PRELIGHT_COLUMNS] that surfaces
// reflect, for vertices and then, when `backs` is not 0, for their backs -> values
// [voxel][3][PRELIGHT_SENT_ORDER^2][PRELIGHT_COLUMNS], the mean over rays of the transfer that arrives along them times
// Y_j of the ray.
__kernel void gatherVolume(__constant const CastParameters* parameters, __constant const SceneLayout* layout,
                           __global const SurfaceLine* surfaceLines, __global const float* geometricNormals,
                           __global const Ray* rays, __global const Hit* hits, __global const float* transfer,
                           uint backs, __global float* values) {
  const size_t voxel = get_global_id(0);
  if (voxel >= parameters->receiverCount) return;
  const uint count = parameters->raysPerReceiver, width = 3 * PRELIGHT_COLUMNS;
  const Surface surface = surfaceOf(layout, surfaceLines);
  float sum[3 * PRELIGHT_SENT_BANDS * PRELIGHT_COLUMNS];
  for (uint i = 0; i < width * PRELIGHT_SENT_BANDS; ++i) sum[i] = 0.0f;
  for (uint r = 0; r < count; ++r) {
    const Hit hit = hits[voxel * count + r];
    if (hit.triangle == PRELIGHT_NO_TRIANGLE) continue;
    const float3 direction = vload3(0, rays[voxel * count + r].direction);
    float sent[3 * PRELIGHT_COLUMNS], bands[PRELIGHT_SENT_BANDS];
    for (uint i = 0; i < width; ++i) sent[i] = 0.0f;
    gatherHit(parameters, surface, geometricNormals, transfer, backs, direction, hit, sent);
    lowBands(direction, bands);
    for (uint c = 0; c < 3; ++c)
      for (uint j = 0; j < PRELIGHT_SENT_BANDS; ++j)
        for (uint i = 0; i < PRELIGHT_COLUMNS; ++i)
          sum[(c * PRELIGHT_SENT_BANDS + j) * PRELIGHT_COLUMNS + i] += bands[j] * sent[c * PRELIGHT_COLUMNS + i];
  }
  for (uint i = 0; i < width * PRELIGHT_SENT_BANDS; ++i)
    values[voxel * width * PRELIGHT_SENT_BANDS + i] = sum[i] / (float)count;
}

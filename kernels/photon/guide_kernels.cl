// Histograms of the directions from which the photons nearest to a place came. Before: photons sorted into maps
// (host/photon/photon_maps). After: rays of a guided final gathering (gather/guided_kernels.cl).
#include "core/octahedral_funcs.cl"
#include "core/sampling_funcs.cl"
#include "photon/density_funcs.cl"
#include "shared/gather_types.h"

// Share of the rays that are drawn evenly; no ray has a weight above its inverse.
#define PRELIGHT_GUIDE_EVEN 0.5f

// Returns the point of the square that concentricDisc8 (core/sampling_block_funcs.cl) maps to a point of the unit disc.
float2 squareOfDisc(float2 disc) {
  const bool wide = fabs(disc.x) > fabs(disc.y);
  const float along = wide ? disc.x : disc.y, across = wide ? disc.y : disc.x;
  if (along == 0.0f) return (float2)(0.5f);
  const float radius = copysign(length(disc), along);
  const float other = radius * atan(across / along) * (4.0f / M_PI_F);
  return clamp(0.5f * (wide ? (float2)(radius, other) : (float2)(other, radius)) + 0.5f, 0.0f, 1.0f);
}

// Returns the cell of a direction above the normal's plane, or PRELIGHT_GUIDE_CELLS for one below it.
uint guideCell(float3 direction, float3 normal, float3 tangent, float3 bitangent) {
  if (!(dot(direction, normal) > 0.0f)) return PRELIGHT_GUIDE_CELLS;
  const float2 at = squareOfDisc((float2)(dot(direction, tangent), dot(direction, bitangent))) * (float)PRELIGHT_GUIDE_SIDE;
  const uint row = min((uint)at.x, PRELIGHT_GUIDE_SIDE - 1u), column = min((uint)at.y, PRELIGHT_GUIDE_SIDE - 1u);
  return row * PRELIGHT_GUIDE_SIDE + column;
}

// Adds the power of photons to the cells of the directions from which they came.
void addToGuide(const DensityMaps maps, const DensityPlace place, float3 normal, float r2, float* cells) {
  float3 tangent, bitangent;
  makeFrame(normal, &tangent, &bitangent);
  for (uint leaf = photonLeafFrom(maps, place, 1u, r2); leaf > 0u; leaf = photonLeafAfter(maps, place, leaf, r2)) {
    __global const PhotonBlock* block = photonBlockOf(maps, place, leaf);
    float weights[8];
    vstore8(photonWeights(maps, place, block, r2), 0, weights);
    for (uint i = 0; i < 8; ++i) {
      if (!(weights[i] > 0.0f)) continue;
      const uint cell = guideCell(unpackDirection(block->direction[i]), normal, tangent, bitangent);
      if (cell < PRELIGHT_GUIDE_CELLS) cells[cell] += weights[i] * (block->red[i] + block->green[i] + block->blue[i]);
    }
  }
}

// One work-item per query. queries [query], whose normals are the axes of the rays -> guides [query][row][column]:
// density over the square, of mean 1, partly uniform and partly proportional to the photons' power.
__kernel void estimateGuides(__constant const DensityParameters* parameters, __global const DensityLine* lines,
                             __global const DensityQuery* queries, __global float* guides) {
  const size_t i = get_global_id(0);
  if (i >= parameters->queryCount) return;
  const DensityMaps maps = densityMapsOf(parameters, lines);
  const float3 normal = normalize(vload3(0, queries[i].normal));
  const DensityPlace place = findDensityPlace(maps, vload3(0, queries[i].position), normal, queries[i].triangle, queries[i].patch);
  float cells[PRELIGHT_GUIDE_CELLS];
  for (uint k = 0; k < PRELIGHT_GUIDE_CELLS; ++k) cells[k] = 0.0f;
  if (place.photons.count > 0u) addToGuide(maps, place, normal, densityReach(maps, place, queries[i].radius), cells);
  float sum = 0.0f;
  for (uint k = 0; k < PRELIGHT_GUIDE_CELLS; ++k) sum += cells[k];
  const float scale = sum > 0.0f ? (1.0f - PRELIGHT_GUIDE_EVEN) * (float)PRELIGHT_GUIDE_CELLS / sum : 0.0f;
  for (uint k = 0; k < PRELIGHT_GUIDE_CELLS; ++k)
    guides[i * PRELIGHT_GUIDE_CELLS + k] = isfinite(scale) && scale > 0.0f ? PRELIGHT_GUIDE_EVEN + scale * cells[k] : 1.0f;
}

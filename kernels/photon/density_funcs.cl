// Irradiance estimated from photons at a point of a surface: the photons of the same region and side (Larsen 2004, ch.
// 8) within a radius, or the k nearest, weighted by a kernel and divided by the kernel's integral over the surface on
// which they may lie.
//
// With k nearest photons the radius is the distance of the k-th, which is not counted itself: k - 1 photons over the
// disc are an unbiased estimate, k would be too many by k / (k - 1) (Garcia et al. 2012).
// PRELIGHT_DENSITY_KERNEL: 0 constant, 1 cone, 2 Epanechnikov. PRELIGHT_DENSITY_NEAREST: k, or 0 for all photons within
// the radius.
#ifndef PRELIGHT_PHOTON_DENSITY_FUNCS_CL
#define PRELIGHT_PHOTON_DENSITY_FUNCS_CL

#include "core/lanes_funcs.cl"
#include "photon/kernel_area_funcs.cl"

#ifndef PRELIGHT_DENSITY_NEAREST
#define PRELIGHT_DENSITY_NEAREST 0
#endif

// Least radius as a share of the query's radius, for the case that k photons lie in one place.
#define PRELIGHT_LEAST_RADIUS 1e-5f

// Areas below this share of r2 are rounding errors: the point then lies beside its triangle.
#define PRELIGHT_LEAST_AREA 1e-6f

// Photon maps and their surface in their buffers (shared/density_types.h).
typedef struct DensityMaps {
  __constant const DensityParameters* parameters;
  __global const LeafTree* photonTrees;     // [patch][front, back]; regions that are not divided come first
  __global const float* photonBoxes;        // [node][lower 3, upper 3]
  __global const PhotonBlock* photonBlocks;
  __global const SurfacePlace* places;      // [triangle]
  __global const LeafTree* areaTrees;       // [region]
  __global const AreaNode* areaNodes;
  __global const AreaTriangle* areaTriangles;
} DensityMaps;

DensityMaps densityMapsOf(__constant const DensityParameters* parameters, __global const DensityLine* lines) {
  const DensityMaps maps = {parameters,
                            (__global const LeafTree*)(lines + parameters->photonTrees),
                            (__global const float*)(lines + parameters->photonBoxes),
                            (__global const PhotonBlock*)(lines + parameters->photonBlocks),
                            (__global const SurfacePlace*)(lines + parameters->places),
                            (__global const LeafTree*)(lines + parameters->areaTrees),
                            (__global const AreaNode*)(lines + parameters->areaNodes),
                            (__global const AreaTriangle*)(lines + parameters->areaTriangles)};
  return maps;
}

// The place of a query: its tangent plane, its region and the photons that it may count.
typedef struct DensityPlace {
  float3 position;
  float3 normal;  // unit normal of its triangle
  uint region;
  uint areaTriangle;
  bool planar;
  float clearance;  // as in SurfacePlace
  LeafTree photons;
} DensityPlace;

// Returns the place of a query. patch: as in DensityQuery.
DensityPlace findDensityPlace(const DensityMaps maps, float3 position, float3 side, uint triangle, uint patch) {
  const SurfacePlace place = maps.places[triangle];
  DensityPlace result;
  result.position = position;
  result.normal = vload3(0, maps.areaTriangles[place.areaTriangle].normal);
  result.region = place.region & ~PRELIGHT_PLANAR_REGION;
  result.areaTriangle = place.areaTriangle;
  result.planar = (place.region & PRELIGHT_PLANAR_REGION) != 0u;
  result.clearance = place.clearance;
  const uint map = patch == PRELIGHT_WHOLE_REGION ? result.region : patch - 1u;
  result.photons = maps.photonTrees[2u * map + (dot(side, result.normal) < 0.0f ? 1u : 0u)];
  return result;
}

// Returns the squared distances of a block's photons from p.
float8 squaredDistances(__global const PhotonBlock* block, float3 p) {
  const float8 x = vload8(0, block->x) - p.x, y = vload8(0, block->y) - p.y, z = vload8(0, block->z) - p.z;
  return x * x + y * y + z * z;
}

// Returns the squared radii from which on a block's photons are counted, given their squared distances. Photons on
// planes away from p count once the radius makes that within the flatness; those on planes that are tilted too much
// never count. Exact up to `limit`.
float8 squaredReaches(const DensityMaps maps, const DensityPlace place, __global const PhotonBlock* block, float8 squared,
                      float limit) {
  float reaches[8];
  vstore8(squared, 0, reaches);
  for (uint i = 0; i < 8; ++i) {
    if (!(reaches[i] < limit)) continue;
    const float3 way = (float3)(block->x[i], block->y[i], block->z[i]) - place.position;
    const float3 normal = vload3(0, maps.areaTriangles[maps.places[block->triangle[i]].areaTriangle].normal);
    const float height = dot(way, normal) / maps.parameters->flatness;
    reaches[i] = dot(place.normal, normal) >= maps.parameters->leastCosine ? fmax(reaches[i], height * height) : MAXFLOAT;
  }
  return vload8(0, reaches);
}

// Returns the kernel K at squared distances, as shares of r2, that are less than 1.
float8 kernelWeights(float8 squared) {
#if PRELIGHT_DENSITY_KERNEL == 0
  return (float8)(1.0f);
#elif PRELIGHT_DENSITY_KERNEL == 1
  return fmax(1.0f - sqrt(squared), 0.0f);
#else
  return fmax(1.0f - squared, 0.0f);
#endif
}

// Returns K for a block's photons, 0 for those that do not count within the squared radius r2.
float8 photonWeights(const DensityMaps maps, const DensityPlace place, __global const PhotonBlock* block, float r2) {
  const float8 squared = squaredDistances(block, place.position);
  const float8 reaches = place.planar ? squared : squaredReaches(maps, place, block, squared, r2);
  return select((float8)(0.0f), kernelWeights(squared * (1.0f / r2)), isless(reaches, (float8)(r2)));
}

// Returns the first leaf from `node` on, in the order of the tree, whose box is nearer to the place than the squared
// radius r2, or 0 when none is left.
uint photonLeafFrom(const DensityMaps maps, const DensityPlace place, uint node, float r2) {
  const uint leaves = 1u << place.photons.levels;
  do {
    __global const float* box = maps.photonBoxes + (place.photons.firstNode + node - 1u) * 6u;
    if (squaredDistanceToBox(place.position, vload3(0, box), vload3(1, box)) < r2) {
      if (node >= leaves) return node;
      node = 2u * node;
    } else {
      node = nodeAfter(node);
    }
  } while (node > 1u);
  return 0u;
}

// Returns the next such leaf after `leaf`.
uint photonLeafAfter(const DensityMaps maps, const DensityPlace place, uint leaf, float r2) {
  const uint node = nodeAfter(leaf);
  return node > 1u ? photonLeafFrom(maps, place, node, r2) : 0u;
}

__global const PhotonBlock* photonBlockOf(const DensityMaps maps, const DensityPlace place, uint leaf) {
  return maps.photonBlocks + place.photons.firstLeaf + leaf - (1u << place.photons.levels);
}

// Returns the kernel-weighted power within the squared radius r2, W.
float3 gatherPower(const DensityMaps maps, const DensityPlace place, float r2) {
  float8 red = 0.0f, green = 0.0f, blue = 0.0f;
  for (uint leaf = photonLeafFrom(maps, place, 1u, r2); leaf > 0u; leaf = photonLeafAfter(maps, place, leaf, r2)) {
    __global const PhotonBlock* block = photonBlockOf(maps, place, leaf);
    const float8 weights = photonWeights(maps, place, block, r2);
    red += weights * vload8(0, block->red);
    green += weights * vload8(0, block->green);
    blue += weights * vload8(0, block->blue);
  }
  return (float3)(sumOf(red), sumOf(green), sumOf(blue));
}

// Returns the area of the surface from which photons within r of a place are counted, weighted by the kernel, m2.
float densityArea(const DensityMaps maps, const DensityPlace place, float r) {
  if (place.planar && (r <= place.clearance || holdsDisc(maps.areaTriangles + place.areaTriangle, place.position, r)))
    return PRELIGHT_DISC_SHARE * M_PI_F * r * r;
  return kernelArea(maps.parameters, maps.areaTrees[place.region], maps.areaNodes, maps.areaTriangles, place.planar,
                    place.position, place.normal, r);
}

#if PRELIGHT_DENSITY_NEAREST > 0
#include "photon/nearest_funcs.cl"
#endif

// Returns the squared radius within which photons count. radius: as in DensityQuery, above 0.
float densityReach(const DensityMaps maps, const DensityPlace place, float radius) {
  float r2 = radius * radius;
#if PRELIGHT_DENSITY_NEAREST > 0
  const float least = fmax(fmin(maps.parameters->minRadius, radius), PRELIGHT_LEAST_RADIUS * radius);
  r2 = holdsNearest(maps, place, least * least) ? least * least : nearestReach(maps, place, r2);
#endif
  return r2;
}

// Returns the irradiance, W/m2, at `position` of `triangle` on the side to which `side` points. radius (above 0),
// patch: as in DensityQuery.
float3 photonIrradiance(const DensityMaps maps, float3 position, float3 side, uint triangle, uint patch, float radius) {
  const DensityPlace place = findDensityPlace(maps, position, side, triangle, patch);
  if (place.photons.count == 0u) return (float3)(0.0f);
  const float r2 = densityReach(maps, place, radius);
  const float3 power = gatherPower(maps, place, r2);
  if (!(power.x > 0.0f || power.y > 0.0f || power.z > 0.0f)) return (float3)(0.0f);
  const float area = fmax(densityArea(maps, place, sqrt(r2)), PRELIGHT_LEAST_AREA * r2);
  return power / area;
}

#endif

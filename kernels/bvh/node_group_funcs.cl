// Intersection of the rays of a group that leave one point with the boxes of a node.
#ifndef PRELIGHT_BVH_NODE_GROUP_FUNCS_CL
#define PRELIGHT_BVH_NODE_GROUP_FUNCS_CL

#include "bvh/block_funcs.cl"

// Bounds of t at a plane x = p for all rays of a group, along one axis:
// entry >= max(lowerEntry (lower - o), upperEntry (upper - o)), exit <= lowerExit (lower - o) + upperExit (upper - o) + exit.
typedef struct AxisInterval {
  float lowerEntry, upperEntry;
  float lowerExit, upperExit, exit;
} AxisInterval;

PRELIGHT_INLINE AxisInterval boundAxis(const float* inverse) {
  const float16 v = vload16(0, inverse);
  const float16 far = (float16)(INFINITY);
  const float leastPositive = least1(select(far, v, v > 0.0f));
  const float leastNegative = least1(select(far, -v, v < 0.0f));  // magnitudes
  AxisInterval a = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
  if (leastPositive < INFINITY) a.lowerEntry = leastPositive;
  if (leastNegative < INFINITY) a.upperEntry = -leastNegative;
  if (leastPositive < INFINITY && leastNegative < INFINITY)
    a.exit = INFINITY;
  else if (leastPositive < INFINITY)
    a.upperExit = -least1(-v);
  else
    a.lowerExit = least1(v);
  return a;
}

// Bounds that all directions of a group have in common.
typedef struct Directions {
  AxisInterval axis[3];
  uint along[3];  // masks of the rays whose dominant axis is x, y, z
} Directions;

PRELIGHT_INLINE void summarise(const RayGroup* g, Directions* d) {
#pragma unroll
  for (uint a = 0; a < 3u; ++a) {
    d->axis[a] = boundAxis(g->inverse[a]);
    d->along[a] = laneMask16(vload16(0, g->axis[2]) == a);
  }
}

// Planes of a node's boxes relative to the group's origin, one row per plane: lower x, y, z, upper x, y, z.
typedef struct RelativeBoxes {
  float plane[6][PRELIGHT_WIDTH];
} RelativeBoxes;

// Returns the mask of the boxes that at least one of the rays may meet, and writes the planes.
PRELIGHT_INLINE uint intersectInterval(__global const WideNode* node, const RayGroup* g, const Directions* d, RelativeBoxes* boxes) {
  float8 entry = (float8)(0.0f), exit = (float8)(INFINITY);
  int8 there = (int8)(0);
#pragma unroll
  for (uint a = 0; a < 3u; ++a) {
    const AxisInterval i = d->axis[a];
    const float8 origin = (float8)(g->origin[a][0]);
    const float8 lower = vload8(0, node->lower[a]) - origin, upper = vload8(0, node->upper[a]) - origin;
    vstore8(lower, 0, boxes->plane[a]);
    vstore8(upper, 0, boxes->plane[3 + a]);
    entry = most8(entry, most8(lower * i.lowerEntry, upper * i.upperEntry));
    exit = least8(exit, lower * i.lowerExit + upper * i.upperExit + i.exit);
    there = lower <= upper;
  }
  return laneMask8((entry <= exit * PRELIGHT_BOX_SLACK) & there);
}

// Returns the mask of the rays that meet one of the boxes in [0, t], and writes the least distance at which they enter
// it.
PRELIGHT_INLINE uint intersectBox(const RelativeBoxes* boxes, uint child, const RayGroup* g, float16 t, float* nearest) {
  const float16 ix = vload16(0, g->inverse[0]), iy = vload16(0, g->inverse[1]), iz = vload16(0, g->inverse[2]);
  const float16 x0 = boxes->plane[0][child] * ix, x1 = boxes->plane[3][child] * ix;
  const float16 y0 = boxes->plane[1][child] * iy, y1 = boxes->plane[4][child] * iy;
  const float16 z0 = boxes->plane[2][child] * iz, z1 = boxes->plane[5][child] * iz;
  const float16 entry = most16(most16(least16(x0, x1), least16(y0, y1)), most16(least16(z0, z1), (float16)(0.0f)));
  const float16 exit = least16(least16(most16(x0, x1), most16(y0, y1)), least16(most16(z0, z1), t)) * PRELIGHT_BOX_SLACK;
#ifndef PRELIGHT_ANY_HIT
  *nearest = least1(select((float16)(INFINITY), entry, entry <= exit));
#endif
  return lessOrEqualMask16(entry, exit);
}

#endif

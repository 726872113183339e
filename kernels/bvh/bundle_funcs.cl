// Traversal of the wide tree by a bundle: a group of rays that leave one point, as a receiver's do. A node or block is
// read once for all rays that meet it.
#ifndef PRELIGHT_BVH_BUNDLE_FUNCS_CL
#define PRELIGHT_BVH_BUNDLE_FUNCS_CL

#include "bvh/walk_funcs.cl"

// Bounds of t at a plane x = p for all rays of a bundle, along one axis:
// entry >= max(lowerEntry (lower - o), upperEntry (upper - o)), exit <= lowerExit (lower - o) + upperExit (upper - o) + exit.
typedef struct AxisInterval {
  float lowerEntry, upperEntry;
  float lowerExit, upperExit, exit;
} AxisInterval;

// From so many rays on, a bundle's boxes are first tested against the interval of its directions; each ray is then tested
// against one box after the other where so few boxes are left. Wide cones leave more.
#define PRELIGHT_MANY_RAYS 7
#define PRELIGHT_FEW_BOXES 2

typedef struct BundleEntry {
  uint child;
  uint entry;  // bits of a distance that no ray of the bundle undercuts
  uint rays;   // mask
  uint pad;
} BundleEntry;

typedef struct Bundle {
  RayGroup rays;
  HitGroup hits;
  AxisInterval axis[3];
  BundleEntry stack[PRELIGHT_STACK_SIZE];  // nearest on top
  uint depth;
  Space space;
  SourceRays world;
} Bundle;

// True when all rays of a group leave one point.
bool sharesOrigin(const RayGroup* g) {
  float16 apart = (float16)(0.0f);
  for (uint a = 0; a < 3; ++a) apart += fabs(vload16(0, g->origin[a]) - (float16)(g->origin[a][0]));
  return lessOrEqualMask16(apart, (float16)(0.0f)) == 0xffffu;
}

float least1(float16 v) {
  const float8 a = least8(v.lo, v.hi);
  const float4 b = fmin(a.lo, a.hi);
  return fmin(fmin(b.x, b.y), fmin(b.z, b.w));
}

AxisInterval boundAxis(const float* inverse) {
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

// Planes of a node's boxes relative to the bundle's origin, a row a plane: lower x, y, z, upper x, y, z.
typedef struct RelativeBoxes {
  float plane[6][PRELIGHT_WIDTH];
} RelativeBoxes;

// Entry distances that no ray of the bundle undercuts; returns the mask of the boxes that one of them may meet.
uint intersectInterval(__global const WideNode* node, const Bundle* bundle, RelativeBoxes* boxes, float8* tNear) {
  float8 entry = (float8)(0.0f), exit = (float8)(INFINITY);
  int8 there = (int8)(0);
  for (uint a = 0; a < 3; ++a) {
    const AxisInterval i = bundle->axis[a];
    const float8 origin = (float8)(bundle->rays.origin[a][0]);
    const float8 lower = vload8(0, node->lower[a]) - origin, upper = vload8(0, node->upper[a]) - origin;
    vstore8(lower, 0, boxes->plane[a]);
    vstore8(upper, 0, boxes->plane[3 + a]);
    entry = most8(entry, most8(lower * i.lowerEntry, upper * i.upperEntry));
    exit = least8(exit, lower * i.lowerExit + upper * i.upperExit + i.exit);
    there = lower <= upper;
  }
  *tNear = entry;
  return laneMask8((entry <= exit * PRELIGHT_BOX_SLACK) & there);
}

// Mask of the rays that meet one of the boxes in [0, t].
uint intersectBundle(const RelativeBoxes* boxes, uint child, const RayGroup* g, float16 t) {
  const float16 ix = vload16(0, g->inverse[0]), iy = vload16(0, g->inverse[1]), iz = vload16(0, g->inverse[2]);
  const float16 x0 = boxes->plane[0][child] * ix, x1 = boxes->plane[3][child] * ix;
  const float16 y0 = boxes->plane[1][child] * iy, y1 = boxes->plane[4][child] * iy;
  const float16 z0 = boxes->plane[2][child] * iz, z1 = boxes->plane[5][child] * iz;
  const float16 entry = most16(most16(least16(x0, x1), least16(y0, y1)), most16(least16(z0, z1), (float16)(0.0f)));
  const float16 exit = least16(least16(most16(x0, x1), most16(y0, y1)), least16(most16(z0, z1), t));
  return lessOrEqualMask16(entry, exit * PRELIGHT_BOX_SLACK);
}

void pushSorted(Bundle* b, uint first, BundleEntry entry) {
  uint at = b->depth++;
  while (at > first && b->stack[at - 1].entry < entry.entry) {
    b->stack[at] = b->stack[at - 1];
    --at;
  }
  b->stack[at] = entry;
}

// Children that the only ray left meets.
PRELIGHT_INLINE void visitWithOne(__global const WideNode* node, Bundle* b, uint mask) {
  const uint lane = lowestLane(mask);
  float8 near8;
  uint children = intersectBoxes(node, &b->rays, lane, b->hits.t[lane], &near8);
  if (children == 0u) return;
  float near[PRELIGHT_WIDTH];
  vstore8(near8, 0, near);
  const uint first = b->depth;
  while (children != 0u) {
    const uint child = lowestLane(children);
    children &= children - 1u;
    const BundleEntry entry = {node->child[child], as_uint(near[child]), mask, 0u};
    pushSorted(b, first, entry);
  }
}

// Children that some of the rays meet, each ray tested against the eight boxes.
PRELIGHT_INLINE void visitWithSeveral(__global const WideNode* node, Bundle* b, uint mask) {
  uchar met[PRELIGHT_GROUP];  // [ray], mask of children
  vstore16((uchar16)(0), 0, met);
  uint children = 0;
  float8 near8 = (float8)(INFINITY);
  while (mask != 0u) {
    const uint lane = lowestLane(mask);
    mask &= mask - 1u;
    float8 n;
    const uint m = intersectBoxes(node, &b->rays, lane, b->hits.t[lane], &n);
    met[lane] = (uchar)m;
    children |= m;
    near8 = least8(near8, n);
  }
  if (children == 0u) return;
  const uchar16 metByRay = vload16(0, met);
  float near[PRELIGHT_WIDTH];
  vstore8(near8, 0, near);
  const uint first = b->depth;
  while (children != 0u) {
    const uint child = lowestLane(children);
    children &= children - 1u;
    const BundleEntry entry = {node->child[child], as_uint(near[child]), byteMask16(metByRay, child), 0u};
    pushSorted(b, first, entry);
  }
}

// Children that some of many rays meet.
PRELIGHT_INLINE void visitWithMany(__global const WideNode* node, Bundle* b, uint mask, float16 t) {
  RelativeBoxes boxes;
  float8 near8;
  uint children = intersectInterval(node, b, &boxes, &near8);
  if (popcount(children) > PRELIGHT_FEW_BOXES) {
    visitWithSeveral(node, b, mask);
    return;
  }
  float near[PRELIGHT_WIDTH];
  vstore8(near8, 0, near);
  const uint first = b->depth;
  while (children != 0u) {
    const uint child = lowestLane(children);
    children &= children - 1u;
    const uint meeting = mask & intersectBundle(&boxes, child, &b->rays, t);
    if (meeting != 0u) {
      const BundleEntry entry = {node->child[child], as_uint(near[child]), meeting, 0u};
      pushSorted(b, first, entry);
    }
  }
}

void startBundle(Bundle* b, uint rays) {
  for (uint a = 0; a < 3; ++a) b->axis[a] = boundAxis(b->rays.inverse[a]);
  const BundleEntry root = {0u, 0u, rays, 0u};
  b->stack[0] = root;
  b->depth = 1;
  b->space = worldSpace();
}

#ifdef PRELIGHT_INSTANCES
void boundDirections(Bundle* b) {
  for (uint a = 0; a < 3; ++a) b->axis[a] = boundAxis(b->rays.inverse[a]);
}

// Takes the rays to the space of what is visited next. Entering an instance is a visit, after which its root is next: then
// true.
PRELIGHT_INLINE bool changeSpaceOfBundle(Bvh bvh, BundleEntry next, uint mask, Bundle* b) {
  const bool enters = isInstance(next.child);
  if (b->depth < b->space.floor) {
    if (!enters) {
      b->rays = b->world.prepared;
      boundDirections(b);
    }
    b->space = worldSpace();
  }
  if (!enters) return false;
  __global const DeviceInstance* instance = bvh.instances + instanceOf(next.child);
  enterWithGroup(instance, &b->world, &b->rays);
  boundDirections(b);
  const BundleEntry root = {instance->root, next.entry, mask, 0u};
  b->stack[b->depth++] = root;
  b->space = spaceOf(instance, b->depth);
  prefetchChild(bvh, root.child);
  return true;
}
#endif

// One visit for a bundle. False when there is nothing left to visit.
PRELIGHT_INLINE bool stepBundle(Bvh bvh, Surface surface, Bundle* b) {
  const float16 t = vload16(0, b->hits.t);
  BundleEntry top;
  uint mask;
  do {
    if (b->depth == 0u) return false;
    top = b->stack[--b->depth];
    mask = top.rays & lessOrEqualMask16((float16)(as_float(top.entry)), t * PRELIGHT_BOX_SLACK);
  } while (mask == 0u);
#ifdef PRELIGHT_INSTANCES
  if (changeSpaceOfBundle(bvh, top, mask, b)) return true;
#endif
  if (top.child & PRELIGHT_LEAF_BIT) {
    __global const TriangleBlock* block = bvh.blocks + (top.child & ~PRELIGHT_LEAF_BIT);
    while (mask != 0u) {
      visitBlock(surface, block, b->space.firstTriangle, &b->rays, lowestLane(mask), &b->hits);
      mask &= mask - 1u;
    }
  } else if ((mask & (mask - 1u)) == 0u) {
    visitWithOne(bvh.nodes + top.child, b, mask);
  } else if (popcount(mask) < PRELIGHT_MANY_RAYS) {
    visitWithSeveral(bvh.nodes + top.child, b, mask);
  } else {
    visitWithMany(bvh.nodes + top.child, b, mask, t);
  }
  if (b->depth == 0u) return false;
  prefetchChild(bvh, b->stack[b->depth - 1u].child);
  return true;
}

#endif

// Traversal of the wide tree by bundles: groups of rays that leave one point, such as a receiver's. A node or block is
// read once for all rays that meet it.
#ifndef PRELIGHT_BVH_BUNDLE_FUNCS_CL
#define PRELIGHT_BVH_BUNDLE_FUNCS_CL

#include "bvh/block_group_funcs.cl"
#include "bvh/node_group_funcs.cl"
#include "bvh/walk_funcs.cl"

// From this number of rays on, a node's boxes are first tested against the interval of the directions, and all rays
// then against each of the remaining boxes in turn. Fewer rays are tested one by one against eight boxes.
#define PRELIGHT_MANY_RAYS 7

// From this number of rays with one dominant axis on, each triangle of a block is tested against all of them at once.
#define PRELIGHT_RAYS_TOGETHER 5

#define PRELIGHT_BUNDLE_ROOM (PRELIGHT_STACK_SIZE + PRELIGHT_WIDTH)  // vector stores write past the used entries

// A group of rays from one point that traverses the tree together: its rays and hits, and its stack.
typedef struct Bundle {
  RayGroup rays;
  HitGroup hits;
  Directions directions;
  uint child[PRELIGHT_BUNDLE_ROOM];    // stack of nodes and blocks, nearest on top
  uint meeting[PRELIGHT_BUNDLE_ROOM];  // for each entry of the stack, the mask of the rays that meet it
#ifndef PRELIGHT_ANY_HIT
  uint entry[PRELIGHT_BUNDLE_ROOM];  // for each entry of the stack, bits of a lower bound of its rays' entry distances
#endif
  uint depth;
  uint next;  // the child that is visited next
  uint mask;  // the rays that visit `next`
  Space space;
  SourceRays world;
} Bundle;

// Returns true when all rays of a group leave one point.
bool sharesOrigin(const RayGroup* g) {
  float16 apart = (float16)(0.0f);
  for (uint a = 0; a < 3; ++a) apart += fabs(vload16(0, g->origin[a]) - (float16)(g->origin[a][0]));
  return lessOrEqualMask16(apart, (float16)(0.0f)) == 0xffffu;
}

#ifdef PRELIGHT_ANY_HIT
// Pushes the children that at least one ray meets.
PRELIGHT_INLINE void pushMet(__global const WideNode* node, uint8 meeting, float8 near8, Bundle* b) {
  uint met = laneMask8(meeting != 0u);
#ifdef PRELIGHT_TOGETHER
  vstore8(together8(vload8(0, node->child), met), 0, b->child + b->depth);
  vstore8(together8(meeting, met), 0, b->meeting + b->depth);
  b->depth += popcount(met);
#else
  uint rays[PRELIGHT_WIDTH];
  vstore8(meeting, 0, rays);
  for (; met != 0u; met &= met - 1u) {
    const uint i = lowestLane(met);
    b->child[b->depth] = node->child[i];
    b->meeting[b->depth++] = rays[i];
  }
#endif
}

// Pops the next child, with the rays that have no hit yet, into `next` and `mask`. Returns false when nothing is left.
PRELIGHT_INLINE bool takeNextOfBundle(Bundle* b) {
  const uint open = lessOrEqualMask16((float16)(0.0f), vload16(0, b->hits.t));
  uint depth = b->depth;
  while (depth != 0u) {
    --depth;
    b->mask = b->meeting[depth] & open;
    if (b->mask == 0u) continue;
    b->next = b->child[depth];
    b->depth = depth;
    return true;
  }
  return false;
}
#else
// Pushes the children that at least one ray meets, the nearest on top. More than four are rare.
PRELIGHT_INLINE void pushMet(__global const WideNode* node, uint8 meeting, float8 near8, Bundle* b) {
  uint met = laneMask8(meeting != 0u);
  const uint first = b->depth;
#ifdef PRELIGHT_TOGETHER
  const uint count = popcount(met);
  if (count <= 4u) {
    // The lowest bits of a distance are replaced by the child's place in the node.
    const uint8 place = (uint8)(0, 1, 2, 3, 4, 5, 6, 7);
    const uint4 keys = descending4(together8((as_uint8(near8) & ~7u) | place, met).lo);
    const uint8 order = (uint8)(keys & 7u, keys & 7u);
    vstore4(permuted8(vload8(0, node->child), order).lo, 0, b->child + first);
    vstore4(permuted8(meeting, order).lo, 0, b->meeting + first);
    vstore4(keys & ~7u, 0, b->entry + first);
    b->depth = first + count;
    return;
  }
#endif
  uint entry[PRELIGHT_WIDTH], rays[PRELIGHT_WIDTH];
  vstore8(as_uint8(near8), 0, entry);
  vstore8(meeting, 0, rays);
  for (; met != 0u; met &= met - 1u) {
    const uint i = lowestLane(met);
    uint at = b->depth++;
    for (; at > first && b->entry[at - 1u] < entry[i]; --at) {
      b->child[at] = b->child[at - 1u];
      b->meeting[at] = b->meeting[at - 1u];
      b->entry[at] = b->entry[at - 1u];
    }
    b->child[at] = node->child[i];
    b->meeting[at] = rays[i];
    b->entry[at] = entry[i];
  }
}

// Pops the next child, with the rays that have no hit in front of it, into `next` and `mask`. Returns false when
// nothing is left.
PRELIGHT_INLINE bool takeNextOfBundle(Bundle* b) {
  const float16 most = vload16(0, b->hits.t) * PRELIGHT_BOX_SLACK;
  uint depth = b->depth;
  while (depth != 0u) {
    --depth;
    b->mask = b->meeting[depth] & lessOrEqualMask16((float16)(as_float(b->entry[depth])), most);
    if (b->mask == 0u) continue;
    b->next = b->child[depth];
    b->depth = depth;
    return true;
  }
  return false;
}
#endif

// Visits a node with several rays, each of which is tested against the eight boxes.
PRELIGHT_INLINE void visitWithSeveral(__global const WideNode* node, Bundle* b) {
  uint8 meeting = (uint8)(0u);
  float8 near8 = (float8)(INFINITY);
  for (uint mask = b->mask; mask != 0u; mask &= mask - 1u) {
    const uint lane = lowestLane(mask);
    float8 entry;
    const int8 met = intersectBoxes(node, &b->rays, lane, b->hits.t[lane], &entry);
    meeting |= as_uint8(met) & (uint8)(1u << lane);
    near8 = select(near8, least8(near8, entry), met);
  }
  pushMet(node, meeting, near8, b);
}

// Visits a node with the only ray left.
PRELIGHT_INLINE void visitWithOne(__global const WideNode* node, Bundle* b) {
  const uint lane = lowestLane(b->mask);
  float8 near8;
  const int8 met = intersectBoxes(node, &b->rays, lane, b->hits.t[lane], &near8);
  pushMet(node, as_uint8(met) & (uint8)(b->mask), near8, b);
}

// Visits a node with many rays, which are tested together against each box that the interval of their directions meets.
PRELIGHT_INLINE void visitWithMany(__global const WideNode* node, Bundle* b) {
  const float16 t = vload16(0, b->hits.t);
  RelativeBoxes boxes;
  uint8 meeting = (uint8)(0u);
  float8 near8 = (float8)(INFINITY);
  for (uint children = intersectInterval(node, &b->rays, &b->directions, &boxes); children != 0u; children &= children - 1u) {
    const uint child = lowestLane(children);
    const int8 here = as_int8((uint8)(0, 1, 2, 3, 4, 5, 6, 7) == (uint8)(child));
    float nearest = 0.0f;
    const uint rays = b->mask & intersectBox(&boxes, child, &b->rays, t, &nearest);
    meeting = select(meeting, (uint8)(rays), as_uint8(here));
    near8 = select(near8, (float8)(nearest), here);
  }
  pushMet(node, meeting, near8, b);
}

PRELIGHT_INLINE void visitBlockOfBundle(Bvh bvh, Surface surface, Bundle* b) {
  __global const TriangleBlock* block = bvh.blocks + (b->next & ~PRELIGHT_LEAF_BIT);
  uint single = b->mask;
#ifndef PRELIGHT_SHADOWS  // needles would be looked at twice then, and their shares of light counted twice
  for (uint kz = 0; kz < 3u; ++kz) {
    const uint mask = b->mask & b->directions.along[kz];
    if (popcount(mask) < PRELIGHT_RAYS_TOGETHER) continue;
    visitBlockTogether(surface, block, b->space.firstTriangle, &b->rays, mask, kz, &b->hits);
    single &= ~mask;
  }
#endif
  for (; single != 0u; single &= single - 1u)
    visitBlock(surface, block, b->space.firstTriangle, &b->rays, lowestLane(single), &b->hits);
}

void startBundle(Bundle* b, uint rays) {
  summarise(&b->rays, &b->directions);
  b->next = 0u;
  b->mask = rays;
  b->depth = 0u;
  b->space = worldSpace();
}

#ifdef PRELIGHT_INSTANCES
// Takes the rays to the space of the child that is visited next. Entering an instance counts as a visit, after which
// the instance's root is next: returns true then.
PRELIGHT_INLINE bool changeSpaceOfBundle(Bvh bvh, Bundle* b) {
  const bool enters = isInstance(b->next);
  if (b->depth < b->space.floor) {
    if (!enters) {
      b->rays = b->world.prepared;
      summarise(&b->rays, &b->directions);
    }
    b->space = worldSpace();
  }
  if (!enters) return false;
  __global const DeviceInstance* instance = bvh.instances + instanceOf(b->next);
  enterWithGroup(instance, &b->world, &b->rays);
  summarise(&b->rays, &b->directions);
  b->space = spaceOf(instance, b->depth + 1u);
  b->next = instance->root;
  prefetchChild(bvh, b->next);
  return true;
}
#endif

// Kinds of visits. Bundles are queued by the kind of their next visit.
#define PRELIGHT_VISITS 4
#define PRELIGHT_VISIT_BLOCK 0u  // or an instance
#define PRELIGHT_VISIT_WITH_ONE 1u
#define PRELIGHT_VISIT_WITH_SEVERAL 2u
#define PRELIGHT_VISIT_WITH_MANY 3u

PRELIGHT_INLINE uint nextVisit(const Bundle* b) {
  const uint rays = popcount(b->mask);
  const uint ofMore = rays < PRELIGHT_MANY_RAYS ? PRELIGHT_VISIT_WITH_SEVERAL : PRELIGHT_VISIT_WITH_MANY;
  const uint ofNode = rays == 1u ? PRELIGHT_VISIT_WITH_ONE : ofMore;
  return b->next & PRELIGHT_LEAF_BIT ? PRELIGHT_VISIT_BLOCK : ofNode;
}

// Performs one visit of a bundle. Returns false when nothing is left to visit.
PRELIGHT_INLINE bool stepBundle(Bvh bvh, Surface surface, uint visit, Bundle* b) {
#ifdef PRELIGHT_INSTANCES
  if (changeSpaceOfBundle(bvh, b)) return true;
#endif
  if (visit == PRELIGHT_VISIT_BLOCK)
    visitBlockOfBundle(bvh, surface, b);
  else if (visit == PRELIGHT_VISIT_WITH_ONE)
    visitWithOne(bvh.nodes + b->next, b);
  else if (visit == PRELIGHT_VISIT_WITH_SEVERAL)
    visitWithSeveral(bvh.nodes + b->next, b);
  else
    visitWithMany(bvh.nodes + b->next, b);
  if (!takeNextOfBundle(b)) return false;
  prefetchChild(bvh, b->next);
  return true;
}

#endif

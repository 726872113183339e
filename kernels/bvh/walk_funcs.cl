// Traversal of the wide tree by rays that have nothing in common. Each has its own walk; several are advanced in turns,
// one node or block at a time, so that the memory that one is about to read arrives while the others work.
#ifndef PRELIGHT_BVH_WALK_FUNCS_CL
#define PRELIGHT_BVH_WALK_FUNCS_CL

#include "bvh/block_funcs.cl"
#include "bvh/instance_group_funcs.cl"

// The wide tree in its buffers.
typedef struct Bvh {
  __global const WideNode* nodes;
  __global const TriangleBlock* blocks;
  __global const DeviceInstance* instances;
} Bvh;

// Prefetches the memory that a visit of `child` will read.
PRELIGHT_INLINE void prefetchChild(Bvh bvh, uint child) {
  if (isInstance(child)) {
    prefetchBytes((__global const char*)(bvh.instances + instanceOf(child)), sizeof(DeviceInstance));
    return;
  }
  // Nodes are smaller than blocks; prefetching as much for both is faster than a branch on which it is.
  __global const char* node = (__global const char*)(bvh.nodes + child);
  __global const char* block = (__global const char*)(bvh.blocks + (child & ~PRELIGHT_LEAF_BIT));
  prefetchBytes(child & PRELIGHT_LEAF_BIT ? block : node, sizeof(TriangleBlock));
}

// An entry of the stack: a child and, for closest hits, the bits of its entry distance above the child's. Distances are
// not negative, so they sort as their bits do.
#ifdef PRELIGHT_ANY_HIT
typedef uint WalkEntry;
#else
typedef ulong WalkEntry;
#endif

// The traversal of the tree by one ray.
typedef struct Walk {
  WalkEntry stack[PRELIGHT_STACK_SIZE + PRELIGHT_WIDTH];  // nearest on top; vector stores write past the used entries
  uint depth;
  uint ray;   // index in the batch
  uint next;  // the child that is visited next
  Space space;
} Walk;

#ifdef PRELIGHT_ANY_HIT
// Pops the next child. Returns false when nothing is left or a hit is known (t < 0).
PRELIGHT_INLINE bool takeNext(Walk* walk, float t) {
  if (walk->depth == 0u || t < 0.0f) return false;
  walk->next = walk->stack[--walk->depth];
  return true;
}

// Pushes the children of the mask.
PRELIGHT_INLINE void pushChildren(__global const WideNode* node, uint mask, float8 near8, Walk* walk) {
#ifdef PRELIGHT_TOGETHER
  vstore8(together8(vload8(0, node->child), mask), 0, walk->stack + walk->depth);
  walk->depth += popcount(mask);
#else
  for (; mask != 0u; mask &= mask - 1u) walk->stack[walk->depth++] = node->child[lowestLane(mask)];
#endif
}
#else
// Pops the next child that is not beyond t. Returns false when nothing is left.
PRELIGHT_INLINE bool takeNext(Walk* walk, float t) {
  const uint most = as_uint(t * PRELIGHT_BOX_SLACK);
  uint depth = walk->depth;
  while (depth != 0u) {
    const ulong top = walk->stack[--depth];
    if ((uint)(top >> 32) <= most) {
      walk->next = (uint)top;
      walk->depth = depth;
      return true;
    }
  }
  return false;
}

// Pushes the children of the mask, the nearest on top. More than four are rare.
PRELIGHT_INLINE void pushChildren(__global const WideNode* node, uint mask, float8 near8, Walk* walk) {
  const uint first = walk->depth;
#ifdef PRELIGHT_TOGETHER
  const uint count = popcount(mask);
  if (count <= 4u) {
    const uint8 near = together8(as_uint8(near8), mask), child = together8(vload8(0, node->child), mask);
    const ulong4 keys = (convert_ulong4(near.lo) << 32) | convert_ulong4(child.lo);
    vstore4(descendingLong4(keys), 0, walk->stack + first);
    walk->depth = first + count;
    return;
  }
#endif
  const ulong8 keys8 = (convert_ulong8(as_uint8(near8)) << 32) | convert_ulong8(vload8(0, node->child));
  ulong keys[PRELIGHT_WIDTH];
  vstore8(keys8, 0, keys);
  for (; mask != 0u; mask &= mask - 1u) {
    const ulong key = keys[lowestLane(mask)];
    uint at = walk->depth++;
    for (; at > first && walk->stack[at - 1u] < key; --at) walk->stack[at] = walk->stack[at - 1u];
    walk->stack[at] = key;
  }
}
#endif

void startWalk(Walk* walk, uint ray) {
  walk->depth = 0u;
  walk->next = 0u;
  walk->ray = ray;
  walk->space = worldSpace();
}

#ifdef PRELIGHT_INSTANCES
// Takes the ray to the space of the child that is visited next. Entering an instance counts as a visit, after which the
// instance's root is next: returns true then.
PRELIGHT_INLINE bool changeSpace(Bvh bvh, const SourceRays* world, RayGroup* g, uint lane, Walk* walk) {
  const bool enters = isInstance(walk->next);
  if (walk->depth < walk->space.floor) {
    if (!enters) leaveWithLane(world, lane, g);
    walk->space = worldSpace();
  }
  if (!enters) return false;
  __global const DeviceInstance* instance = bvh.instances + instanceOf(walk->next);
  enterWithLane(instance, world, lane, g);
  walk->space = spaceOf(instance, walk->depth + 1u);
  walk->next = instance->root;
  prefetchChild(bvh, walk->next);
  return true;
}
#endif

// Visits a node. Returns false when nothing is left to visit.
PRELIGHT_INLINE bool stepToNode(Bvh bvh, const SourceRays* world, RayGroup* g, uint lane, Walk* walk, const HitGroup* hits) {
#ifdef PRELIGHT_INSTANCES
  changeSpace(bvh, world, g, lane, walk);
#endif
  __global const WideNode* node = bvh.nodes + walk->next;
  const float t = hits->t[lane];
  float8 near8;
  const uint mask = laneMask8(intersectBoxes(node, g, lane, t, &near8));
  pushChildren(node, mask, near8, walk);
  if (!takeNext(walk, t)) return false;
  prefetchChild(bvh, walk->next);
  return true;
}

// Visits a block or enters an instance. Returns false when nothing is left to visit.
PRELIGHT_INLINE bool stepToLeaf(Bvh bvh, Surface surface, const SourceRays* world, RayGroup* g, uint lane, Walk* walk,
                                HitGroup* hits) {
#ifdef PRELIGHT_INSTANCES
  if (changeSpace(bvh, world, g, lane, walk)) return true;
#endif
  visitBlock(surface, bvh.blocks + (walk->next & ~PRELIGHT_LEAF_BIT), walk->space.firstTriangle, g, lane, hits);
  if (!takeNext(walk, hits->t[lane])) return false;
  prefetchChild(bvh, walk->next);
  return true;
}

#endif

// Traversal of the wide tree by rays that have nothing in common. Each has a walk of its own; several are advanced in
// turns, a node or a block at a time, so that the memory that one is about to read arrives while the others work.
#ifndef PRELIGHT_BVH_WALK_FUNCS_CL
#define PRELIGHT_BVH_WALK_FUNCS_CL

#include "bvh/block_funcs.cl"
#include "bvh/instance_group_funcs.cl"

typedef struct Bvh {
  __global const WideNode* nodes;
  __global const TriangleBlock* blocks;
  __global const DeviceInstance* instances;
} Bvh;

// Asks for what a visit of `child` will read.
void prefetchChild(Bvh bvh, uint child) {
  if (isInstance(child))
    prefetchBytes((__global const char*)(bvh.instances + instanceOf(child)), sizeof(DeviceInstance));
  else if (child & PRELIGHT_LEAF_BIT)
    prefetchBytes((__global const char*)(bvh.blocks + (child & ~PRELIGHT_LEAF_BIT)), sizeof(TriangleBlock));
  else
    prefetchBytes((__global const char*)(bvh.nodes + child), sizeof(WideNode));
}

// Entry distances are not negative: they sort as their bits do.
typedef struct WalkEntry {
  uint child;
  uint entry;  // bits of the distance
} WalkEntry;

typedef struct Walk {
  WalkEntry stack[PRELIGHT_STACK_SIZE];  // nearest on top
  uint depth;
  uint ray;  // in the batch
  Space space;
} Walk;

#define PRELIGHT_NOWHERE 0xffffffffu

// Next of the stack that is not beyond `t`.
uint popWalk(Walk* walk, float t) {
  while (walk->depth != 0u) {
    const WalkEntry top = walk->stack[--walk->depth];
    if (as_float(top.entry) <= t * PRELIGHT_BOX_SLACK) return top.child;
  }
  return PRELIGHT_NOWHERE;
}

// Puts the children of the mask on the stack, the nearest on top.
void pushChildren(__global const WideNode* node, uint mask, float8 near8, Walk* walk) {
  float near[PRELIGHT_WIDTH];
  vstore8(near8, 0, near);
  const uint first = walk->depth;
  while (mask != 0u) {
    const uint child = lowestLane(mask);
    mask &= mask - 1u;
    const WalkEntry entry = {node->child[child], as_uint(near[child])};
    uint at = walk->depth++;
#ifndef PRELIGHT_ANY_HIT
    while (at > first && walk->stack[at - 1u].entry < entry.entry) {
      walk->stack[at] = walk->stack[at - 1u];
      --at;
    }
#endif
    walk->stack[at] = entry;
  }
}

void startWalk(Walk* walk, uint ray) {
  const WalkEntry root = {0u, 0u};
  walk->stack[0] = root;
  walk->depth = 1u;
  walk->ray = ray;
  walk->space = worldSpace();
}

#ifdef PRELIGHT_INSTANCES
// Takes the ray to the space of what is visited next. Entering an instance is a visit, after which its root is next: then
// true.
PRELIGHT_INLINE bool changeSpace(Bvh bvh, uint next, const SourceRays* world, RayGroup* g, uint lane, Walk* walk) {
  const bool enters = isInstance(next);
  if (walk->depth < walk->space.floor) {
    if (!enters) leaveWithLane(world, lane, g);
    walk->space = worldSpace();
  }
  if (!enters) return false;
  __global const DeviceInstance* instance = bvh.instances + instanceOf(next);
  enterWithLane(instance, world, lane, g);
  const WalkEntry root = {instance->root, 0u};
  walk->stack[walk->depth++] = root;
  walk->space = spaceOf(instance, walk->depth);
  prefetchChild(bvh, root.child);
  return true;
}
#endif

// One visit. False when there is nothing left to visit.
PRELIGHT_INLINE bool stepWalk(Bvh bvh, Surface surface, const SourceRays* world, RayGroup* g, uint lane, Walk* walk,
                              HitGroup* hits) {
  const uint current = popWalk(walk, hits->t[lane]);
  if (current == PRELIGHT_NOWHERE) return false;
#ifdef PRELIGHT_INSTANCES
  if (changeSpace(bvh, current, world, g, lane, walk)) return true;
#endif
  if (current & PRELIGHT_LEAF_BIT) {
    visitBlock(surface, bvh.blocks + (current & ~PRELIGHT_LEAF_BIT), walk->space.firstTriangle, g, lane, hits);
  } else {
    __global const WideNode* node = bvh.nodes + current;
    float8 near8;
    const uint mask = intersectBoxes(node, g, lane, hits->t[lane], &near8);
    pushChildren(node, mask, near8, walk);
  }
  if (walk->depth == 0u) return false;
  prefetchChild(bvh, walk->stack[walk->depth - 1u].child);
  return true;
}

#endif

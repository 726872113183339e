// Traversal of the wide tree by the batch of rays of one work-item.
// Options: PRELIGHT_ANY_HIT (a hit only says that there is one; otherwise the closest is found), PRELIGHT_SHADOWS (in
// addition, hits are shares of light, bvh/shadow_funcs.cl), PRELIGHT_ALPHA_TEST, PRELIGHT_VERTEX_COLORS,
// PRELIGHT_SHARED_SURFACE, PRELIGHT_INSTANCES (the tree has two levels), PRELIGHT_STACK_SIZE (entries that the tree
// needs).
#ifndef PRELIGHT_BVH_WIDE_FUNCS_CL
#define PRELIGHT_BVH_WIDE_FUNCS_CL

#ifndef PRELIGHT_STACK_SIZE
#define PRELIGHT_STACK_SIZE 256
#endif
#include "bvh/bundle_funcs.cl"

// Number of groups that are prefetched ahead of the one being prepared.
#define PRELIGHT_GROUPS_AHEAD 4

// Number of loose rays, those not in bundles, that are traversed at a time.
#define PRELIGHT_WALKS 32

// All rays of a work-item.
typedef struct Batch {
  Bundle bundles[PRELIGHT_BATCH_GROUPS];
  uint bundle[PRELIGHT_BATCH_GROUPS];  // indices of the bundles in use
  uint bundleCount;
  uint loose[PRELIGHT_BATCH];  // indices of the rays that are in no bundle
  uint looseCount;
#ifdef PRELIGHT_SHADOWS
  ShadowScene scene;
#endif
} Batch;

void prepareBatch(__global const Ray* rays, uint count, Batch* batch) {
  batch->bundleCount = 0u;
  batch->looseCount = 0u;
  for (uint first = 0; first < count; first += PRELIGHT_GROUP) {
    prefetchBytes((__global const char*)(rays + first + PRELIGHT_GROUPS_AHEAD * PRELIGHT_GROUP), PRELIGHT_GROUP * sizeof(Ray));
    const uint group = first / PRELIGHT_GROUP;
    const uint n = min(count - first, (uint)PRELIGHT_GROUP);
    Bundle* b = batch->bundles + group;
#ifdef PRELIGHT_INSTANCES
    prepareSourceRays(rays + first, n, &b->world);
    b->rays = b->world.prepared;
#else
    prepareGroup(rays + first, n, &b->rays);
#endif
    clearHits(&b->rays, &b->hits);
#ifdef PRELIGHT_SHADOWS
    startShadows(rays + first, &batch->scene, &b->hits);
#endif
    if (sharesOrigin(&b->rays)) {
      startBundle(b, (1u << n) - 1u);
      batch->bundle[batch->bundleCount++] = group;
    } else {
      for (uint lane = 0; lane < n; ++lane) batch->loose[batch->looseCount++] = first + lane;
    }
  }
}

// Active bundles, by the kind of their next visit. Each loop performs visits of one kind: mixed kinds would be
// mispredicted half of the time.
typedef struct BundleQueues {
  uint* of[PRELIGHT_VISITS];  // indices of bundles
  uint count[PRELIGHT_VISITS];
} BundleQueues;

PRELIGHT_INLINE void enqueueBundle(const Batch* batch, uint bundle, BundleQueues* q) {
  const uint next = nextVisit(batch->bundles + bundle);
#pragma unroll
  for (uint visit = 0; visit < PRELIGHT_VISITS; ++visit) {  // written to all queues, kept in one
    q->of[visit][q->count[visit]] = bundle;
    q->count[visit] += next == visit;
  }
}

void traceBundles(Bvh bvh, Surface surface, Batch* batch) {
  uint blocks[PRELIGHT_BATCH_GROUPS + 1], one[PRELIGHT_BATCH_GROUPS + 1], several[PRELIGHT_BATCH_GROUPS + 1],
      many[PRELIGHT_BATCH_GROUPS + 1];
  BundleQueues q = {{blocks, one, several, many}, {0u, 0u, 0u, 0u}};
  for (uint i = 0; i < batch->bundleCount; ++i) enqueueBundle(batch, batch->bundle[i], &q);
  while (q.count[0] + q.count[1] + q.count[2] + q.count[3] != 0u) {
#pragma unroll
    for (uint visit = 0; visit < PRELIGHT_VISITS; ++visit) {
      const uint count = q.count[visit];
      q.count[visit] = 0u;
      for (uint i = 0; i < count; ++i) {
        const uint bundle = q.of[visit][i];
        if (stepBundle(bvh, surface, visit, batch->bundles + bundle)) enqueueBundle(batch, bundle, &q);
      }
    }
  }
}

// Active walks, by the kind of their next visit. Each loop performs visits of one kind: mixed kinds would be
// mispredicted half of the time.
typedef struct WalkQueues {
  uint* nodes;   // [nodeCount] indices of walks
  uint* leaves;  // [leafCount]
  uint nodeCount, leafCount;
  uint waiting;  // number of loose rays of the batch that have not been started
} WalkQueues;

PRELIGHT_INLINE void enqueue(const Walk* walks, uint walk, WalkQueues* q) {
  const uint leaf = walks[walk].next >> 31;  // written to both queues, kept in one
  q->nodes[q->nodeCount] = walk;
  q->leaves[q->leafCount] = walk;
  q->nodeCount += 1u - leaf;
  q->leafCount += leaf;
}

// Starts the next loose ray in a walk that has ended. Returns false when none is waiting.
PRELIGHT_INLINE bool restart(const Batch* batch, Walk* walk, WalkQueues* q) {
  if (q->waiting == 0u) return false;
  startWalk(walk, batch->loose[--q->waiting]);
  return true;
}

PRELIGHT_INLINE void visitNodes(Bvh bvh, Batch* batch, Walk* walks, WalkQueues* q) {
  const uint count = q->nodeCount;
  q->nodeCount = 0u;
  for (uint i = 0; i < count; ++i) {
    Walk* walk = walks + q->nodes[i];
    Bundle* b = batch->bundles + walk->ray / PRELIGHT_GROUP;
    if (stepToNode(bvh, &b->world, &b->rays, walk->ray % PRELIGHT_GROUP, walk, &b->hits) || restart(batch, walk, q))
      enqueue(walks, (uint)(walk - walks), q);
  }
}

PRELIGHT_INLINE void visitLeaves(Bvh bvh, Surface surface, Batch* batch, Walk* walks, WalkQueues* q) {
  const uint count = q->leafCount;
  q->leafCount = 0u;
  for (uint i = 0; i < count; ++i) {
    Walk* walk = walks + q->leaves[i];
    Bundle* b = batch->bundles + walk->ray / PRELIGHT_GROUP;
    if (stepToLeaf(bvh, surface, &b->world, &b->rays, walk->ray % PRELIGHT_GROUP, walk, &b->hits) || restart(batch, walk, q))
      enqueue(walks, (uint)(walk - walks), q);
  }
}

void traceLoose(Bvh bvh, Surface surface, Batch* batch) {
  Walk walks[PRELIGHT_WALKS];
  uint nodes[PRELIGHT_WALKS + 1], leaves[PRELIGHT_WALKS + 1];
  WalkQueues q = {nodes, leaves, 0u, 0u, batch->looseCount};
  for (uint i = 0; i < PRELIGHT_WALKS; ++i)
    if (restart(batch, walks + i, &q)) enqueue(walks, i, &q);
  while (q.nodeCount + q.leafCount != 0u) {
    visitNodes(bvh, batch, walks, &q);
    visitLeaves(bvh, surface, batch, walks, &q);
  }
}

PRELIGHT_INLINE void writeHits(const Batch* batch, uint count, __global Hit* hits) {
  for (uint first = 0; first < count; first += PRELIGHT_GROUP)
#ifdef PRELIGHT_SHADOWS
    writeShadows(&batch->bundles[first / PRELIGHT_GROUP].hits, count - first, hits + first);
#else
    writeGroup(&batch->bundles[first / PRELIGHT_GROUP].hits, count - first, hits + first);
#endif
}

void traceBatch(Bvh bvh, Surface surface, Batch* batch) {
  traceBundles(bvh, surface, batch);
  traceLoose(bvh, surface, batch);
}

#endif

// Distance of the k-th nearest photon: a heap holds the k least squared distances so far, and nearer boxes are visited
// first.
#ifndef PRELIGHT_PHOTON_NEAREST_FUNCS_CL
#define PRELIGHT_PHOTON_NEAREST_FUNCS_CL

// Stack size for the deepest tree, of 2^24 blocks.
#define PRELIGHT_NEAREST_STACK 26

// Replaces the root, the greatest value, of a heap of `count` values by `value`.
void replaceRoot(float* heap, uint count, float value) {
  uint at = 0u;
  for (uint child = 1u; child < count; child = 2u * at + 1u) {
    if (child + 1u < count && heap[child + 1u] > heap[child]) ++child;
    if (!(heap[child] > value)) break;
    heap[at] = heap[child];
    at = child;
  }
  heap[at] = value;
}

// Appends a value to a heap of `count` values.
void appendToHeap(float* heap, uint count, float value) {
  uint at = count;
  while (at > 0u) {
    const uint parent = (at - 1u) / 2u;
    if (!(heap[parent] < value)) break;
    heap[at] = heap[parent];
    at = parent;
  }
  heap[at] = value;
}

// Adds a block's photons to the heap and returns the greatest squared reach that still matters.
float visitBlock(const DensityMaps maps, const DensityPlace place, __global const PhotonBlock* block, float* heap,
                 uint* count, float limit) {
  float8 squared = squaredDistances(block, place.position);
  if (!any(isless(squared, (float8)(limit)))) return limit;
  if (!place.planar) squared = squaredReaches(maps, place, block, squared, limit);
  float reaches[8];
  vstore8(squared, 0, reaches);
  for (uint i = 0; i < 8; ++i) {
    if (!(reaches[i] < limit)) continue;
    if (*count < PRELIGHT_DENSITY_NEAREST)
      appendToHeap(heap, (*count)++, reaches[i]);
    else
      replaceRoot(heap, PRELIGHT_DENSITY_NEAREST, reaches[i]);
    if (*count == PRELIGHT_DENSITY_NEAREST) limit = heap[0];
  }
  return limit;
}

// Returns true when at least k photons lie within a squared reach, which is far cheaper than finding them.
bool holdsNearest(const DensityMaps maps, const DensityPlace place, float limit) {
  if (place.photons.count < PRELIGHT_DENSITY_NEAREST) return false;
  const uint leaves = 1u << place.photons.levels;
  int count = 0;
  uint node = 1u;
  do {
    __global const float* box = maps.photonBoxes + (place.photons.firstNode + node - 1u) * 6u;
    if (squaredDistanceToBox(place.position, vload3(0, box), vload3(1, box)) < limit) {
      if (node < leaves) {
        node = 2u * node;
        continue;
      }
      __global const PhotonBlock* block = maps.photonBlocks + place.photons.firstLeaf + node - leaves;
      float8 reaches = squaredDistances(block, place.position);
      if (!place.planar) reaches = squaredReaches(maps, place, block, reaches, limit);
      const int8 inside = isless(reaches, (float8)(limit));  // -1 in the lanes inside
      const int4 four = inside.lo + inside.hi;
      count -= four.x + four.y + four.z + four.w;
      if (count >= PRELIGHT_DENSITY_NEAREST) return true;
    }
    node = nodeAfter(node);
  } while (node > 1u);
  return false;
}

// Returns the squared reach of the k-th nearest photon, or `limit` where fewer than k are below it.
float nearestReach(const DensityMaps maps, const DensityPlace place, float limit) {
  if (place.photons.count < PRELIGHT_DENSITY_NEAREST) return limit;
  float heap[PRELIGHT_DENSITY_NEAREST];
  uint stack[PRELIGHT_NEAREST_STACK];
  float distances[PRELIGHT_NEAREST_STACK];
  const uint leaves = 1u << place.photons.levels;
  __global const float* boxes = maps.photonBoxes + place.photons.firstNode * 6u;
  uint count = 0u, top = 0u;
  stack[top] = 1u;
  distances[top++] = 0.0f;
  while (top > 0u) {
    --top;
    if (!(distances[top] < limit)) continue;
    uint node = stack[top];
    while (node < leaves) {
      __global const float* left = boxes + (2u * node - 1u) * 6u;
      const float a = squaredDistanceToBox(place.position, vload3(0, left), vload3(1, left));
      const float b = squaredDistanceToBox(place.position, vload3(2, left), vload3(3, left));
      const uint near = a <= b ? 2u * node : 2u * node + 1u;
      if (fmax(a, b) < limit) {
        stack[top] = near ^ 1u;
        distances[top++] = fmax(a, b);
      }
      node = fmin(a, b) < limit ? near : 0u;
      if (node == 0u) break;
    }
    if (node == 0u) continue;
    limit = visitBlock(maps, place, maps.photonBlocks + place.photons.firstLeaf + node - leaves, heap, &count, limit);
  }
  return limit;
}

#endif

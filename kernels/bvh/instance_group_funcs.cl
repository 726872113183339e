// Groups of rays in the spaces of a two-level tree: that of the scene, and those of the shapes that are instanced.
// Distances along a ray are equal in both, because directions are not normalised again. All boxes and triangles of a
// shape are tested with one transformed ray, so closed surfaces stay closed.
// Options: PRELIGHT_INSTANCES (the tree has two levels).
#ifndef PRELIGHT_BVH_INSTANCE_GROUP_FUNCS_CL
#define PRELIGHT_BVH_INSTANCE_GROUP_FUNCS_CL

#include "bvh/group_funcs.cl"
#include "bvh/intersect_funcs.cl"
#include "shared/instance_types.h"

bool isInstance(uint child) {
#ifdef PRELIGHT_INSTANCES
  return (child & (PRELIGHT_LEAF_BIT | PRELIGHT_INSTANCE_BIT)) == (PRELIGHT_LEAF_BIT | PRELIGHT_INSTANCE_BIT);
#else
  return false;
#endif
}

uint instanceOf(uint child) { return child & ~(PRELIGHT_LEAF_BIT | PRELIGHT_INSTANCE_BIT); }

// The space in which a traversal is at present.
typedef struct Space {
  uint firstTriangle;  // index of the first triangle of the blocks in this space
  uint floor;          // the space has been left when the stack is lower than this; 0 for the scene's space
} Space;

Space worldSpace(void) {
  const Space space = {0u, 0u};
  return space;
}

// Returns the space of an instance whose root has just been pushed to depth `depth`.
Space spaceOf(__global const DeviceInstance* instance, uint depth) {
  const Space space = {instance->firstTriangle, depth - 1u};
  return space;
}

// Rays as they were passed in, in the scene's space.
typedef struct SourceRays {
#ifdef PRELIGHT_INSTANCES
  RayGroup prepared;
  float direction[3][PRELIGHT_GROUP];
#else
  uint none;
#endif
} SourceRays;

#ifdef PRELIGHT_INSTANCES
void prepareSourceRays(__global const Ray* rays, uint count, SourceRays* world) {
  loadGroup(rays, count, &world->prepared, world->direction);
  prepareDirections(vload16(0, world->direction[0]), vload16(0, world->direction[1]), vload16(0, world->direction[2]),
                    &world->prepared);
}

// Returns the rays' source triangles as indices within an instance, or PRELIGHT_NO_TRIANGLE where the source is
// another's: the subtraction then wraps around to an index that the shape does not have.
uint16 sourceWithin16(__global const DeviceInstance* instance, uint16 source) {
  const uint16 own = source - instance->firstTriangle;
  return select((uint16)(PRELIGHT_NO_TRIANGLE), own, as_uint16(own < instance->triangleCount));
}

// Takes all rays of a group to an instance's space.
void enterWithGroup(__global const DeviceInstance* instance, const SourceRays* world, RayGroup* g) {
  const float16 ox = vload16(0, world->prepared.origin[0]) - instance->centre[0],
                oy = vload16(0, world->prepared.origin[1]) - instance->centre[1],
                oz = vload16(0, world->prepared.origin[2]) - instance->centre[2];
  const float16 dx = vload16(0, world->direction[0]), dy = vload16(0, world->direction[1]), dz = vload16(0, world->direction[2]);
  float16 direction[3];
  for (uint a = 0; a < 3; ++a) {
    __global const float* row = instance->toShape[a];
    vstore16(row[0] * ox + row[1] * oy + row[2] * oz, 0, g->origin[a]);
    direction[a] = row[0] * dx + row[1] * dy + row[2] * dz;
  }
  prepareDirections(direction[0], direction[1], direction[2], g);
  vstore16(sourceWithin16(instance, vload16(0, world->prepared.source)), 0, g->source);
}

// Takes one ray of a group to an instance's space and leaves the others where they are.
void enterWithLane(__global const DeviceInstance* instance, const SourceRays* world, uint lane, RayGroup* g) {
  Ray ray;
  for (uint a = 0; a < 3; ++a) {
    __global const float* row = instance->toShape[a];
    ray.origin[a] = row[0] * (world->prepared.origin[0][lane] - instance->centre[0]) +
                    row[1] * (world->prepared.origin[1][lane] - instance->centre[1]) +
                    row[2] * (world->prepared.origin[2][lane] - instance->centre[2]);
    ray.direction[a] =
        row[0] * world->direction[0][lane] + row[1] * world->direction[1][lane] + row[2] * world->direction[2][lane];
    g->origin[a][lane] = ray.origin[a];
  }
  ray.tMax = world->prepared.tMax[lane];
  ray.sourceTriangle = world->prepared.source[lane];
  const PreparedRay r = prepareRay(ray);
  const float inverse[3] = {r.inverseDirection.x, r.inverseDirection.y, r.inverseDirection.z};
  for (uint a = 0; a < 3; ++a) {
    g->inverse[a][lane] = inverse[a];
    g->entry[a][lane] = a * PRELIGHT_WIDTH + (inverse[a] >= 0.0f ? 0u : 3u * PRELIGHT_WIDTH);
  }
  g->shear[0][lane] = r.sx;
  g->shear[1][lane] = r.sy;
  g->shear[2][lane] = r.sz;
  g->axis[0][lane] = (uint)r.kx;
  g->axis[1][lane] = (uint)r.ky;
  g->axis[2][lane] = (uint)r.kz;
  const uint own = ray.sourceTriangle - instance->firstTriangle;
  g->source[lane] = own < instance->triangleCount ? own : PRELIGHT_NO_TRIANGLE;
}

// Takes one ray back to the scene's space.
void leaveWithLane(const SourceRays* world, uint lane, RayGroup* g) {
  for (uint a = 0; a < 3; ++a) {
    g->origin[a][lane] = world->prepared.origin[a][lane];
    g->inverse[a][lane] = world->prepared.inverse[a][lane];
    g->shear[a][lane] = world->prepared.shear[a][lane];
    g->axis[a][lane] = world->prepared.axis[a][lane];
    g->entry[a][lane] = world->prepared.entry[a][lane];
  }
  g->source[lane] = world->prepared.source[lane];
}
#endif

#endif

// The two layouts of the bounding volume hierarchy. Both come from one binary tree built on the host. In a
// two-level tree, the nodes and leaves of all shapes, of triangles outside shapes and of the tree over these
// lie in the same buffers.
#ifndef PRELIGHT_SHARED_BVH_TYPES_H
#define PRELIGHT_SHARED_BVH_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

/// Set in a child reference to a leaf. An absent child of a wide node has an inverted box, which no ray hits.
#define PRELIGHT_LEAF_BIT 0x80000000u

/// Set in addition to the leaf bit of a wide node's child that is an instance; the other bits are its index.
#define PRELIGHT_INSTANCE_BIT 0x40000000u

#define PRELIGHT_WIDTH 8

/// A work-item takes a batch of rays through the wide tree, in groups of rays that fill one vector register
/// of AVX-512.
#define PRELIGHT_GROUP 16
#define PRELIGHT_BATCH_GROUPS 16
#define PRELIGHT_BATCH (PRELIGHT_BATCH_GROUPS * PRELIGHT_GROUP)

/// Eight children side by side, one row per axis, for devices with vector registers (CPUs). A leaf reference
/// is PRELIGHT_LEAF_BIT | index of a TriangleBlock.
typedef struct WideNode {
  float lower[3][PRELIGHT_WIDTH];
  float upper[3][PRELIGHT_WIDTH];
  uint child[PRELIGHT_WIDTH];
} WideNode;

/// Up to eight triangles tested at once; unused lanes are degenerate and carry PRELIGHT_NO_TRIANGLE.
typedef struct TriangleBlock {
  float vertex[3][3][PRELIGHT_WIDTH];  ///< [corner][axis][lane]
  uint triangle[PRELIGHT_WIDTH];
} TriangleBlock;

#define PRELIGHT_LEAF_COUNT_SHIFT 27
#define PRELIGHT_LEAF_FIRST_MASK 0x07ffffffu

/// Two children with both boxes in the parent (Aila and Laine 2009), for devices that trace one ray per lane
/// (GPUs). A leaf reference is PRELIGHT_LEAF_BIT | count << 27 | index of its first NarrowTriangle, with
/// count 1..8. A count of 0 marks an instance, whose index is in the other bits.
typedef struct NarrowNode {
  float lower[2][3];
  float upper[2][3];
  uint child[2];
  uint pad[2];
} NarrowNode;

/// A triangle of the narrow layout.
typedef struct NarrowTriangle {
  float vertex[3][3];  ///< [corner][axis]
  uint triangle;
} NarrowTriangle;

PRELIGHT_SHARED_END

#endif

// Photon maps and the surface on which photons lie, as density estimation reads them.
#ifndef PRELIGHT_SHARED_DENSITY_TYPES_H
#define PRELIGHT_SHARED_DENSITY_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

#define PRELIGHT_BLOCK_PHOTONS 8u
#define PRELIGHT_LEAF_TRIANGLES 4u

/// A complete binary tree: node 1 is the root, nodes 2 i and 2 i + 1 are node i's children, the leaves are
/// the last 2^levels ones. Node i lies at firstNode + i - 1.
typedef struct LeafTree {
  uint firstNode;
  uint firstLeaf;  ///< first element of the leaves' contents
  uint levels;
  uint count;  ///< number of elements in all leaves; 0: nothing to visit
} LeafTree;

/// A leaf of up to eight photons as a structure of arrays. Unused lanes lie far away and have no power.
typedef struct PhotonBlock {
  float x[8];  ///< scene coordinates
  float y[8];
  float z[8];
  uint triangle[8];
  float red[8];  ///< W
  float green[8];
  float blue[8];
  uint direction[8];  ///< as Photon::direction
} PhotonBlock;

/// A node over triangles of a region.
typedef struct AreaNode {
  float lower[3];  ///< scene coordinates
  float area;      ///< m2
  float upper[3];
  float moment;        ///< integral over the surface of the squared distance from `centre`, m4
  float centre[3];     ///< centroid of the area
  float spread;        ///< cosine of the largest angle between `normal` and a triangle's
  float normal[3];     ///< unit
  uint triangleCount;  ///< leaves: number of triangles
} AreaNode;

/// A leaf's triangle i lies at (firstLeaf + leaf) x PRELIGHT_LEAF_TRIANGLES + i.
typedef struct AreaTriangle {
  float corners[9];  ///< scene coordinates
  float normal[3];   ///< unit, geometric
} AreaTriangle;

#define PRELIGHT_PLANAR_REGION 0x80000000u

/// Stands for all photons of a region, instead of a patch's number; these begin at 1.
#define PRELIGHT_WHOLE_REGION 0u

/// The place of a triangle of the scene in the arrays of density estimation.
typedef struct SurfacePlace {
  uint region;        ///< | PRELIGHT_PLANAR_REGION where the region lies in one plane
  uint areaTriangle;  ///< index among the AreaTriangles
  /// m; any disc of up to this radius around a point of the triangle, in its plane, lies within its region.
  float clearance;
} SurfacePlace;

/// 64 bytes of a buffer of arrays, like SurfaceLine.
typedef struct DensityLine {
  uint words[16];
} DensityLine;

/// Parameters of density estimation, and the places of its arrays.
typedef struct DensityParameters {
  float minRadius;    ///< m; least radius of k nearest photons
  float leastCosine;  ///< between the normals of the query's triangle and of a photon's
  float flatness;     ///< largest distance of the query from a photon's plane, in radii
  uint queryCount;
  // The first DensityLine of each array.
  uint places;         ///< SurfacePlace [triangle]
  uint areaTrees;      ///< LeafTree [region]
  uint areaNodes;      ///< AreaNode
  uint areaTriangles;  ///< AreaTriangle
  uint photonTrees;    ///< LeafTree [patch][front, back]
  uint photonBoxes;    ///< float [node][lower 3, upper 3]
  uint photonBlocks;   ///< PhotonBlock
} DensityParameters;

/// A point at which the density of photons is estimated.
typedef struct DensityQuery {
  float position[3];  ///< on the surface, scene coordinates
  uint triangle;
  float normal[3];  ///< on the side whose light is sought; only the side matters
  float radius;     ///< m, > 0; with k nearest photons the largest radius
  uint patch;       ///< patch whose photons count, 1 + its number in the maps, or PRELIGHT_WHOLE_REGION
} DensityQuery;

/// Grid of a map's photons: cell (x, y, z) is cell (z x cells[1] + y) x cells[0] + x after firstCell.
typedef struct PhotonGrid {
  float lower[3];  ///< scene coordinates
  float perCell;   ///< 1/m
  uint cells[3];
  uint firstCell;
} PhotonGrid;

PRELIGHT_SHARED_END

#endif

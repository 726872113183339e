#pragma once

#include <span>

#include "occluders/occluder_tree.h"
#include "prelight/transfer.h"

namespace prelight {

/// Merges the occluders of every vertex along the tree where that costs least, until vertices have at most
/// `recordsPerVertex` records on average. `leaves` holds OccluderVector::Occlusion, and its occluders are
/// leaves of the tree. Records of the result belong to tree nodes, none of which contains another within a
/// vertex. A record is the sum of the leaves below it, so that form factors of a vertex add up to the same. A
/// node with only one leaf that a vertex sees is replaced by this leaf with its unchanged record; records
/// without form factor are omitted.
///
/// With form factor F, occlusion vector D, and A the area of the vertex relative to the mean, the error of a
/// record is E = A F sqrt(1 - |D|/F), which merging never decreases. The cut of a vertex minimises the sum of
/// E + price over its records. Bisection finds the price, common to all vertices, that uses 99.8 % of the
/// limit, or as much as possible. No vertex has fewer records than roots that it sees; if even those exceed
/// the limit, they are the result. Leaves that are within the limit are not merged.
///
/// `areaOfVertex` is [vertex], m2, >= 0. Vertices without area have all records merged as soon as any are.
/// `recordsPerVertex` >= 0 is an average over all vertices, including those that see no occluder.
OccluderTransfer cutOccluders(const OccluderTransfer& leaves, const OccluderTree& tree,
                              std::span<const double> areaOfVertex, double recordsPerVertex);

/// Form factor of dropped occluders, a share of the hemisphere that counts as unoccluded from then on.
struct DroppedOccluders {
  double mean = 0.0;  ///< mean over vertices
  double most = 0.0;  ///< largest of a vertex
};

/// Removes records whose form factor is below `leastFormFactor`.
DroppedOccluders dropOccluders(OccluderTransfer& transfer, double leastFormFactor);

}  // namespace prelight

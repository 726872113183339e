#pragma once

#include <span>

#include "occluders/occluder_tree.h"
#include "prelight/transfer.h"

namespace prelight {

/// Joins the occluders of every vertex up the tree where that costs least, until the vertices have at most
/// `recordsPerVertex` records in the mean. `leaves` holds OccluderVector::Occlusion; its occluders are leaves
/// of the tree. Records of the result belong to tree nodes, none above another within a vertex; a record is
/// what the leaves below it would sum up to, so that form factors of a vertex add up to what they did. A node
/// with a single leaf that a vertex sees is replaced by that leaf, whose record stays as it is; records
/// without form factor are left out.
///
/// With form factor F, occlusion vector D and A the vertex' area over the mean one, a record's error is
/// E = A F sqrt(1 - |D|/F), which joining never lessens. A vertex' cut minimizes the sum of E + price over
/// its records; the price, one for all, is what bisection finds to fill the limit to 99.8 %, or as far as it
/// can. No vertex has fewer records than roots that it sees: where even those exceed the limit, they are the
/// result. Leaves that are within it stay apart.
///
/// areaOfVertex: m2, not negative [vertex]. Those of vertices without area are all joined, as soon as any
/// are. recordsPerVertex: >= 0, of all vertices, also those that see no occluder.
OccluderTransfer cutOccluders(const OccluderTransfer& leaves, const OccluderTree& tree,
                              std::span<const double> areaOfVertex, double recordsPerVertex);

}  // namespace prelight

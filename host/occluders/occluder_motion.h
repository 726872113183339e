#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "occluders/carried_record.h"
#include "occluders/occluder_body.h"
#include "occluders/rigid_motion.h"
#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"

namespace prelight {

/// A k-d tree of points for searches by cost.
class PointTree {
 public:
  explicit PointTree(std::span<const glm::dvec3> points);

  /// Returns the cost of a point, infinity if it may not be chosen. It must never be below `scale` x squared
  /// distance to the place of the search.
  using CostOf = std::function<double(std::uint32_t point)>;

  struct Found {
    std::uint32_t point = 0;
    double cost = 0.0;
  };

  /// Returns the cheapest of the first `most` points visited, nearby ones first, or `best` if none is
  /// cheaper.
  Found cheapest(const glm::dvec3& place, double scale, const CostOf& costOf, Found best,
                 std::size_t most) const;

 private:
  struct Search;
  void split(std::size_t begin, std::size_t end);
  void visit(std::size_t begin, std::size_t end, Search& search) const;

  std::vector<glm::dvec3> points_;    ///< in tree order: the median of a range is its node
  std::vector<std::uint32_t> order_;  ///< parallel to points_, index in the original order
  std::vector<std::uint8_t> axes_;    ///< parallel to points_, axis of a node's plane
};

/// Motions of occluders and vertices since the bake.
struct OccluderMotions {
  std::vector<RigidMotion> motions;
  std::vector<std::uint32_t> ofVertex;    ///< [vertex], index into motions
  std::vector<std::uint32_t> ofOccluder;  ///< [occluder], index into motions
};

/// Vector occluders of a scene whose parts move rigidly (Sherif 2013, 7.7.2), derived from those of its bake
/// without rays.
///
/// The record of an occluder that moved relative to a vertex is taken from the vertex that had about the same
/// position relative to it in the bake (possibly itself), carried along and corrected for the difference of
/// the two places (carryRecord). Occluders that no such vertex could see are treated as balls. Vertices keep
/// the records of occluders that move with them, bit for bit where nothing has moved. Where form factors
/// would exceed the whole hemisphere, moved occluders hide the others; where others fill the hemisphere
/// around a moved occluder, they also fill what it uncovers.
///
/// Every result is computed from the bake: errors do not accumulate, and moving back restores the bake.
class OccluderMover {
 public:
  /// `rest` must hold positions, occlusion, diffuse normals and colours. `rest` and `scene`, in the pose of
  /// the bake, must outlive the object.
  OccluderMover(const OccluderTransfer& rest, const CompiledScene& scene, const OccluderMembers& members);

  /// Returns the transfer after motions. Form factors of a vertex sum to at most 1; moved records below
  /// `leastFormFactor` are omitted. Takes O(records + moved bodies x vertices x log) time.
  OccluderTransfer moved(const OccluderMotions& motions, double leastFormFactor = 1e-5) const;

 private:
  struct Row;
  struct MovedClass;
  std::vector<MovedClass> classesOf(const OccluderMotions& motions) const;
  std::uint32_t sourceOf(const OccluderMotions& motions, const MovedClass& moved, std::uint32_t vertex,
                         const OccluderView& to) const;
  void addSeen(const OccluderMotions& motions, const MovedClass& moved, std::uint32_t vertex,
               const OccluderView& to, double leastFormFactor, Row& row) const;
  void addKept(const OccluderMotions& motions, std::uint32_t vertex, Row& row) const;
  void makeRow(const OccluderMotions& motions, const std::vector<MovedClass>& classes, std::uint32_t vertex,
               double leastFormFactor, Row& row) const;

  const OccluderTransfer& rest_;
  std::size_t occlusion_;              ///< index of occlusion in `stored`
  std::vector<OccluderView> views_;    ///< [vertex], in the pose of the bake
  std::vector<std::uint32_t> rootOf_;  ///< [occluder], root of the tree that contains it
  std::vector<OccluderBody> bodies_;   ///< [occluder]
  PointTree tree_;                     ///< the vertices
};

}  // namespace prelight

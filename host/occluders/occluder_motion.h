#pragma once

#include <cstdint>
#include <vector>

#include "occluders/carried_record.h"
#include "occluders/occluder_body.h"
#include "occluders/point_tree.h"
#include "occluders/rigid_motion.h"
#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"

namespace prelight {

/// Where occluders and vertices have gone since the bake.
struct OccluderMotions {
  std::vector<RigidMotion> motions;
  std::vector<std::uint32_t> ofVertex;    ///< [vertex], into motions
  std::vector<std::uint32_t> ofOccluder;  ///< [occluder], into motions
};

/// Vector occluders of a scene whose parts move rigidly (Sherif 2013, 7.7.2), from those of its bake: no
/// rays.
///
/// What a vertex sees of an occluder that moved relative to it is what some vertex saw of it in the bake,
/// that stood to it then about as this one does now (itself, where that is nearest), carried along and
/// changed by how the two places differ (carryRecord). Occluders that none such could see are seen as balls.
/// Vertices keep what goes along with them, to the bit where nothing has moved. An occluder that comes before
/// others hides them where there would be more than a whole sky; where others fill the sky around it they
/// also fill what it uncovers.
///
/// It starts from the bake every time: errors do not add up, and going back undoes everything.
class OccluderMover {
 public:
  /// `rest`, which must hold positions, occlusion, diffuse normals and colours, and `scene`, as it was baked,
  /// outlive it.
  OccluderMover(const OccluderTransfer& rest, const CompiledScene& scene, const OccluderMembers& members);

  /// The transfer after motions. Form factors of a vertex add up to 1 at most; records of less than
  /// `leastFormFactor` are left out, unless they have not moved. O(records + moved bodies x vertices x log).
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
  std::size_t occlusion_;              ///< place in `stored`
  std::vector<OccluderView> views_;    ///< [vertex], in the bake
  std::vector<std::uint32_t> rootOf_;  ///< [occluder], that it is a part of
  std::vector<OccluderBody> bodies_;   ///< [occluder]
  PointTree tree_;                     ///< of the vertices
};

}  // namespace prelight

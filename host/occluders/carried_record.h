#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "occluders/occluder_body.h"
#include "occluders/rigid_motion.h"
#include "prelight/transfer.h"

namespace prelight {

/// A place that sees occluders, in world space.
struct OccluderView {
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0};  ///< unit

  bool operator==(const OccluderView&) const = default;
};

/// Returns a body after a motion.
OccluderBody movedBody(const OccluderBody& body, const RigidMotion& motion);

/// Computes the record that `to` has of an occluder that moved, [stored], from the record that `from` had of
/// it before. The record and its vertex move along with the occluder; then the view is changed from there to
/// `to`. The form factor is scaled by the ratio of the ball's form factors, and directions turn with the
/// direction to its centre. `body` is the occluder's, or for a part that of the whole, which works better.
/// Within the body's reach, and for displacements that are short compared with it, the change is reduced,
/// because an occluder that surrounds a vertex goes on doing so. The result is exact up to rounding where
/// `to` is `from` after the motion. It may have a form factor of 0.
void carryRecord(std::span<const OccluderVector> stored, std::span<const glm::vec4> record,
                 const OccluderView& from, const RigidMotion& motion, const OccluderBody& body,
                 const OccluderView& to, std::span<glm::vec4> carried);

/// Computes the record that `to` has of a body without an earlier record: that of its ball. `body` is at its
/// present place.
void ballRecord(std::span<const OccluderVector> stored, const OccluderBody& body, const OccluderView& to,
                std::span<glm::vec4> record);

/// Returns whether nothing that `from` saw predicts how `to` sees an occluder: its ball was (nearly) hidden
/// below the horizon there and is above it here.
bool comesIntoView(const OccluderView& from, const RigidMotion& motion, const OccluderBody& body,
                   const OccluderView& to);

/// Scales the parts of a record that are proportional to a share of the hemisphere: form factor, directions
/// and normals.
void scaleRecord(std::span<const OccluderVector> stored, double factor, std::span<glm::vec4> record);

}  // namespace prelight

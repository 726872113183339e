#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "occluders/occluder_body.h"
#include "occluders/rigid_motion.h"
#include "prelight/transfer.h"

namespace prelight {

/// A place that sees occluders, world space.
struct OccluderView {
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0};  ///< unit

  bool operator==(const OccluderView&) const = default;
};

/// A body after a motion.
OccluderBody movedBody(const OccluderBody& body, const RigidMotion& motion);

/// Writes what `to` sees of an occluder that moved, [stored], from a record of what `from` saw of it before:
/// the record and its vertex are carried along with the occluder, and from there seen from `to`. The form
/// factor changes as that of the body's ball does, the directions turn with the way to its centre; `body` is
/// the occluder's, or for a part that of the whole, which serves better. Within its reach, and for ways that
/// are short beside it, less is changed: what surrounds a vertex goes on doing so. Exact, but for rounding,
/// where `to` is `from` after the motion. The result may have a form factor of 0.
void carryRecord(std::span<const OccluderVector> stored, std::span<const glm::vec4> record,
                 const OccluderView& from, const RigidMotion& motion, const OccluderBody& body,
                 const OccluderView& to, std::span<glm::vec4> carried);

/// Writes what `to` sees of a body of which there is no record: its ball. `body` is where it is now.
void ballRecord(std::span<const OccluderVector> stored, const OccluderBody& body, const OccluderView& to,
                std::span<glm::vec4> record);

/// Whether nothing that `from` saw says how `to` sees an occluder: its ball was hidden below the horizon
/// there, or nearly, and is above it here.
bool comesIntoView(const OccluderView& from, const RigidMotion& motion, const OccluderBody& body,
                   const OccluderView& to);

/// Scales what a record says of a share of the sky: form factor, directions and normals.
void scaleRecord(std::span<const OccluderVector> stored, double factor, std::span<glm::vec4> record);

}  // namespace prelight

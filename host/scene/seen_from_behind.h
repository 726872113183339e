#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// What is to become of a triangle that is seen from behind.
enum BehindMark : std::uint8_t {
  ShowsBothSides = 1,  ///< its back is drawn and lit as its front is
  FrontIsWithin = 2    ///< its back becomes its front, as that is where it is looked at from
};

struct SeenFromBehind {
  std::vector<std::uint8_t> marks;       ///< [triangle], bits of BehindMark; empty: no surface is marked
  std::vector<std::string> shutInLamps;  ///< a sentence for each that something encloses which is no room
};

/// Finds surfaces that look away from a room which they enclose. Whatever a viewpoint has around it is such a
/// room where their backs are what it sees first in a quarter of all directions or more, and cover more than
/// half of the sphere around it, fronts counted against backs: closed or nearly closed surfaces, or several
/// together. A lamp within makes it a room where its light falls on something else as well, so that what
/// merely houses a lamp stays what it is; a camera where a lamp shines in there, or light comes in from
/// outside; and either where there is nothing outside.
SeenFromBehind seenFromBehind(const Scene& scene, const CompiledScene& compiled);

/// Parts of surfaces all of whose triangles were turned to their normals (turnWoundBack()) whose winding was
/// right, as cameras and lamps see them from behind now, or, where those tell nothing, as they are closed and
/// look inwards. [triangle], 1: of such a part; empty: there is none.
std::vector<std::uint8_t> wronglyTurned(const Scene& scene, const CompiledScene& compiled);

}  // namespace prelight

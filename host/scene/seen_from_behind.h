#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// A place from which surfaces are seen or lit.
struct Viewpoint {
  glm::dvec3 place{0.0};  ///< scene coordinates
  bool camera = false;    ///< otherwise a lamp
  std::string name = {};  ///< name of a lamp, for messages
};

/// Returns a scene's cameras, then its lamps: point and spot lights, and for each emissive primitive a place
/// just in front of its largest triangle. Returns at most `most`, evenly selected from the cameras and from
/// the lamps.
std::vector<Viewpoint> viewpointsOf(const Scene& scene, const CompiledScene& compiled, std::size_t most);

/// The treatment of a triangle that is seen from behind.
enum BehindMark : std::uint8_t {
  ShowsBothSides = 1,  ///< its back is drawn and lit like its front
  FrontIsWithin = 2    ///< its back becomes its front, because it is looked at from there
};

/// The result of seenFromBehind().
struct SeenFromBehind {
  std::vector<std::uint8_t> marks;  ///< [triangle], bits of BehindMark; empty: no surface is marked
  /// One sentence per lamp that is enclosed by something that is no room.
  std::vector<std::string> shutInLamps;
};

/// Finds surfaces that enclose a room and face away from it. A viewpoint is in such a room where backs are
/// what it sees first in at least a quarter of all directions, and where these surfaces cover more than half
/// of the sphere around it, fronts counted against backs: closed or nearly closed surfaces, or several
/// together. In addition, a lamp inside must light something else as well, so that mere lamp housings are
/// unchanged; a camera inside requires a lamp inside or light from outside; and either suffices where nothing
/// lies outside.
SeenFromBehind seenFromBehind(const Scene& scene, const CompiledScene& compiled);

/// Returns [triangle] 1 for parts of surfaces all of whose triangles were turned to their normals
/// (turnWoundBack()) although their winding was right: cameras and lamps see them from behind now or, where
/// those do not decide, they are closed and look inwards. Empty: there are none.
std::vector<std::uint8_t> wronglyTurned(const Scene& scene, const CompiledScene& compiled);

}  // namespace prelight

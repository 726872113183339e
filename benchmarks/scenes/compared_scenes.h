#pragma once

#include <optional>
#include <string>

#include "benchmarks/run/measure.h"
#include "prelight/picture.h"
#include "scene/gltf/gltf_document.h"

namespace prelight::benchmarks {

/// The parts of a scene of which one was put in last.
struct PutObject {
  BenchmarkScene without;  ///< the scene before
  BenchmarkScene object;   ///< by itself, where it stands; its vertices are the scene's last
};

/// A scene that techniques are compared on.
struct ComparedScene {
  BenchmarkScene scene;
  GltfDocument document;                ///< the document that `scene` was loaded from
  std::optional<Environment> sky = {};  ///< nothing else lights the scene, where there is one
  std::optional<PutObject> put = {};
  std::vector<Light> lamps = {};  ///< lights in place of the scene's own; empty: its own

  /// "20 lights", "a sky".
  std::string light() const;
};

/// The built-in scene `shapes`.
ComparedScene makeShapes();

/// `shapes` with a polished ground and a ball and a ring of metal, so that things mirror one another.
ComparedScene makeShinyShapes();

/// Balls, rings, boxes, cones and cylinders of many colours on a ground of 16 m, every sixth of polished
/// metal, under coloured point lights above them; 25 objects make about 25 000 vertices and 50 000 triangles,
/// as in Sherif's thesis (2013), Figure 7.1. The same anywhere.
ComparedScene makeCrowd(int objects, int lights);

/// The crowd without its lights, under a sky.
ComparedScene makeCrowdUnder(const Environment& sky, int objects);

/// Half a crowd under a sky, the last of its objects put in.
ComparedScene makeCrowdWithObject(const Environment& sky, int objects);

/// The closed room `cornell` by the lamp in its ceiling.
ComparedScene makeRoom();

/// The built-in scene `rooms`, a quad and a ball in place of its lamp.
ComparedScene makeRoomsByAreaLights();

/// An evening: blue above, warm at the horizon, with a low sun of ten degrees, the ground dark. Mean radiance
/// about 1.
Environment makeEveningSky(int rows);

}  // namespace prelight::benchmarks

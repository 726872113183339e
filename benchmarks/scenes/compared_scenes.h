#pragma once

#include <optional>
#include <string>

#include "benchmarks/run/measure.h"
#include "prelight/picture.h"
#include "scene/gltf/gltf_document.h"

namespace prelight::benchmarks {

/// A scene without its last object, and that object.
struct PutObject {
  BenchmarkScene without;  ///< the scene before
  BenchmarkScene object;   ///< the object alone, at its place; its vertices are the last of the scene
};

/// A scene on which techniques are compared.
struct ComparedScene {
  BenchmarkScene scene;
  GltfDocument document;                ///< the document that `scene` was loaded from
  std::optional<Environment> sky = {};  ///< if present, the only light of the scene
  std::optional<PutObject> put = {};
  std::vector<Light> lamps = {};  ///< lights that replace the scene's own; empty: none do

  /// Returns what lights the scene: "20 lights", "a sky".
  std::string light() const;
};

/// Returns the built-in scene `shapes`.
ComparedScene makeShapes();

/// Returns the built-in scene `shiny`.
ComparedScene makeShinyShapes();

/// Returns the built-in scene `crowd` with another number of objects and lights.
ComparedScene makeCrowd(int objects, int lights);

/// Returns the crowd without its lights, under a sky.
ComparedScene makeCrowdUnder(const Environment& sky, int objects);

/// Returns half a crowd under a sky; its last object was put in later.
ComparedScene makeCrowdWithObject(const Environment& sky, int objects);

/// Returns the closed room `cornell`, lit by the lamp in its ceiling.
ComparedScene makeRoom();

/// Returns the built-in scene `rooms` with a quad and a ball as lights instead of its lamp.
ComparedScene makeRoomsByAreaLights();

/// Returns an evening sky: blue above, warm at the horizon, with a low sun of ten degrees and a dark ground.
/// Its mean radiance is about 1.
Environment makeEveningSky(int rows);

}  // namespace prelight::benchmarks

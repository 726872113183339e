#pragma once

#include <memory>

#include "benchmarks/run/measure.h"
#include "gi/update/live_light.h"

namespace prelight::benchmarks {

/// Draws pictures of global illumination of a scene with live light by OpenGL, without a window.
class LiveDrawing {
 public:
  /// Pictures have side x side pixels with one sample each. The scene and its light must outlive this object.
  /// Throws Error without OpenGL.
  LiveDrawing(const BenchmarkScene& scene, const LiveLight& live, int side);
  ~LiveDrawing();

  /// Applies the changes of a frame, draws it, and waits until it is drawn.
  void draw(const LiveFrame& frame, bool moved);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace prelight::benchmarks

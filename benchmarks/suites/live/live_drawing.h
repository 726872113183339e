#pragma once

#include <memory>

#include "benchmarks/run/measure.h"
#include "gi/update/live_light.h"

namespace prelight::benchmarks {

/// Pictures of global illumination, drawn by OpenGL without a window, of a scene whose light is live.
class LiveDrawing {
 public:
  /// The scene and its light outlive it; pictures of side x side pixels, one sample each. Throws Error
  /// without OpenGL.
  LiveDrawing(const BenchmarkScene& scene, const LiveLight& live, int side);
  ~LiveDrawing();

  /// Takes over what a frame changed, draws, and waits until it is drawn.
  void draw(const LiveFrame& frame, bool moved);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace prelight::benchmarks

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "relight/vertex_lights.h"

namespace prelight {

/// What objects take from the transfer of a scene's vertices, [vertex].
struct ObjectShadow {
  std::vector<float> hidden;     ///< share of the cosine-weighted hemisphere where objects are seen first
  std::vector<float> sky;        ///< [vertex][i], SH transfer of what is hidden where the sky would be seen
  std::vector<float> surfaces;   ///< share as `hidden` where surfaces would be seen
  std::vector<float> sent = {};  ///< [vertex][channel 3][i], SH transfer of what objects send; empty: nothing
};

/// Casts rays from the vertices of a baked scene towards the balls around objects.
class ObjectShadowCaster {
 public:
  /// `walls` is the baked scene, `whole` has the objects, too. Both outlive it.
  /// `order`: bands of what is hidden of the sky.
  ObjectShadowCaster(Tracer& whole, Tracer& walls, int order) : whole_(whole), walls_(walls), order_(order) {}

  /// Of the vertices of `baked`, whose triangles are the scene's first; objects are the ranges behind.
  ObjectShadow cast(const CompiledScene& scene, const VertexRange& baked,
                    std::span<const VertexRange> objects);

 private:
  /// Rays of a vertex to an object, what they count together.
  struct Aim {
    std::uint32_t vertex = 0;
    double weight = 0.0;  ///< of each ray, without its cosine
  };

  void castAims(const CompiledScene& scene, std::span<const Aim> aims, const std::vector<device::Ray>& rays,
                std::uint32_t bakedTriangles, ObjectShadow& shadow);

  Tracer& whole_;
  Tracer& walls_;
  int order_;
};

}  // namespace prelight

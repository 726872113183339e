#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "relight/vertex_lights.h"

namespace prelight {

/// Light that objects hide from and send to the vertices of a scene, [vertex].
struct ObjectShadow {
  std::vector<float> hidden;    ///< share of the cosine-weighted hemisphere covered by objects
  std::vector<float> sky;       ///< [vertex][i], SH transfer of the covered part in front of the sky
  std::vector<float> surfaces;  ///< share of the hemisphere covered in front of surfaces
  /// [vertex][channel 3][i], SH transfer of light sent by objects; empty: nothing.
  std::vector<float> sent = {};
};

/// Casts rays from the vertices of a baked scene towards the balls around objects.
class ObjectShadowCaster {
 public:
  /// `walls` is the baked scene, and `whole` includes the objects. Both must outlive the object. `order` is
  /// the number of bands of hidden sky light.
  ObjectShadowCaster(Tracer& whole, Tracer& walls, int order) : whole_(whole), walls_(walls), order_(order) {}

  /// Returns the shadow on the vertices of `baked`, whose triangles are the scene's first; objects are later
  /// ranges.
  ObjectShadow cast(const CompiledScene& scene, const VertexRange& baked,
                    std::span<const VertexRange> objects);

 private:
  /// Rays from a vertex to an object.
  struct Aim {
    std::uint32_t vertex = 0;
    double weight = 0.0;  ///< weight of each ray, without its cosine
  };

  void castAims(const CompiledScene& scene, std::span<const Aim> aims, const std::vector<device::Ray>& rays,
                std::uint32_t bakedTriangles, ObjectShadow& shadow);

  Tracer& whole_;
  Tracer& walls_;
  int order_;
};

}  // namespace prelight

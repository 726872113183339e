#pragma once

#include <span>
#include <vector>

#include "prelight/bake.h"
#include "relight/object_light.h"

namespace prelight {

/// Transfer of a baked scene's vertices with the shadows of objects that stand among it:
///
///   lamps     what shadow rays, or ways past occluders, lose to objects
///   sky       SH of the directions where an object hides it
///   surfaces  their share of the hemisphere that objects hide, as though they shone evenly
///
/// What objects reflect onto the scene is in it where their neighbourhoods tell of it.
class ShadowedTransfer {
 public:
  /// `bake` is of the scene's vertices `baked`, in three channels, whose triangles are the scene's first.
  ShadowedTransfer(const CompiledScene& scene, const VertexRange& baked, const Bake& bake,
                   ObjectScene& light);

  /// Writes it to a bake, for objects where the scene has them.
  void writeTo(const CompiledScene& scene, std::span<const VertexRange> objects, Bake& bake);

 private:
  void writeSh(const ObjectShadow& shadow, HarmonicTransfer& sh) const;
  void writeLights(const ObjectShadow& shadow, const std::vector<float>& lamps,
                   LightGroupTransfer& lights) const;

  VertexRange baked_;
  ObjectScene& light_;
  int order_ = 1;
  std::vector<float> sh_;      ///< [vertex][3][i] without objects
  std::vector<float> direct_;  ///< [vertex][i] of `sh_`, what no surface has sent; empty: not known
  std::vector<float> lights_;  ///< [vertex][3][group] without objects
  std::vector<float> lamps_;   ///< of them, what is direct
};

}  // namespace prelight

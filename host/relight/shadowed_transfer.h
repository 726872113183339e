#pragma once

#include <span>
#include <vector>

#include "prelight/bake.h"
#include "relight/object_light.h"

namespace prelight {

/// Transfer of a baked scene's vertices with the shadows of objects placed in it:
///
///   lamps     light that objects block on shadow rays, or by vector occluders
///   sky       SH of the directions in which an object hides it
///   surfaces  the share of their hemisphere that objects hide, as if all of it had the same radiance
///
/// Light that objects reflect onto the scene is included if their neighbourhoods are known.
class ShadowedTransfer {
 public:
  /// `bake` holds the scene's vertices `baked`, in three channels; their triangles are the scene's first.
  ShadowedTransfer(const CompiledScene& scene, const VertexRange& baked, const Bake& bake,
                   ObjectScene& light);

  /// Writes the transfer to a bake for the objects' present places.
  void writeTo(const CompiledScene& scene, std::span<const VertexRange> objects, Bake& bake);

 private:
  void writeSh(const ObjectShadow& shadow, HarmonicTransfer& sh) const;
  void writeLights(const ObjectShadow& shadow, const std::vector<float>& lamps,
                   LightGroupTransfer& lights) const;

  VertexRange baked_;
  ObjectScene& light_;
  int order_ = 1;
  std::vector<float> sh_;      ///< [vertex][3][i] without objects
  std::vector<float> direct_;  ///< [vertex][i], direct part of `sh_`; empty: not known
  std::vector<float> lights_;  ///< [vertex][3][group] without objects
  std::vector<float> lamps_;   ///< direct part of `lights_`
};

}  // namespace prelight

#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "export/export_request.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"

namespace prelight {

/// Vertex colours with baked light or occlusion, multiplied by the scene's own vertex colours.
class BakedColors {
 public:
  BakedColors(const CompiledScene& scene, const Bake& bake, ExportForm form);

  /// Returns whether the form has colours.
  bool present() const { return form_ == ExportForm::VertexLight || form_ == ExportForm::VertexOcclusion; }

  /// Returns the radiance, W/(m2 sr), of a colour of 1. It exceeds the radiance of white diffuse surfaces
  /// except for the brightest hundredth.
  float scale() const { return scale_; }

  /// Returns linear colours, 0..1, [vertex of the range]. If `lamp`, the range's material, is given, the
  /// colours include its base colour and emission; else they multiply a base colour and include no emission.
  std::vector<glm::vec4> of(const PrimitiveRange& range, const CompiledMaterial* lamp = nullptr) const;

 private:
  const CompiledScene& scene_;
  const Bake& bake_;
  ExportForm form_;
  float scale_ = 1.0f;
};

}  // namespace prelight

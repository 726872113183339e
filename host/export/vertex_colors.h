#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "export/export_request.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"

namespace prelight {

/// Colours of a scene's vertices that hold what was baked, times those that it has.
class BakedColors {
 public:
  BakedColors(const CompiledScene& scene, const Bake& bake, ExportForm form);

  /// Whether the form has colours.
  bool present() const { return form_ == ExportForm::VertexLight || form_ == ExportForm::VertexOcclusion; }

  /// W/(m2 sr) that light of 1 stands for: above the radiance of white diffuse surfaces but for its brightest
  /// hundredth.
  float scale() const { return scale_; }

  /// [vertex of the range], 0..1, linear. `lamp`: the range's material, whose base colour and emission the
  /// colours hold as well; nullptr: the colours multiply a base colour, and nothing shines.
  std::vector<glm::vec4> of(const PrimitiveRange& range, const CompiledMaterial* lamp = nullptr) const;

 private:
  const CompiledScene& scene_;
  const Bake& bake_;
  ExportForm form_;
  float scale_ = 1.0f;
};

}  // namespace prelight

#include "viewer/core/render_inputs.h"

#include "encodings/registry/registry.h"
#include "techniques/encoded_light/held_encodings.h"

namespace prelight::viewer {

const Bake* bakeOf(Shading shading, const RenderInputs& inputs) {
  const ShadingInfo& info = infoOf(shading);
  const bool posed = inputs.posed != nullptr && !info.bakeOption.empty() && info.carriedBy(*inputs.posed);
  return posed ? inputs.posed : inputs.bake;
}

DrawingRules rulesOf(Shading shading, const RenderInputs& inputs) {
  const ShadingInfo& info = infoOf(shading);
  DrawingRules rules = info.rules;
  if (inputs.encoding != nullptr && inputs.bake != nullptr &&
      encodedFor(info.encoded, *inputs.bake, inputs.encoding->name) != nullptr)
    rules.ambient = info.encoded;
  return rules;
}

}  // namespace prelight::viewer

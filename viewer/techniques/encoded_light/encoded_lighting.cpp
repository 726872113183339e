#include "viewer/techniques/encoded_light/encoded_lighting.h"

#include "encodings/registry/registry.h"
#include "techniques/encoded_light/held_encodings.h"
#include "viewer/gl/texture.h"
#include "viewer/programs/surface_uniforms.h"
#include "viewer/techniques/light_map/light_map_lighting.h"

namespace prelight::viewer {
namespace {

/// Light that arrives at vertices, interpolated in the fragment shader.
class EncodedVertexLighting final : public DrawnTransfer {
 public:
  explicit EncodedVertexLighting(const EncodedLight& light)
      : values_(gl::makeBufferTexture(std::span<const float>(light.values), 1, GL_R32F, "encoded light")) {}

  void light(const Illumination&) override {}
  void bind(const gl::Program&) const override {
    setUnknownAccessibility();
    gl::bind(encodedVerticesUnit, GL_TEXTURE_BUFFER, values_.texture);
  }
  void describe(const Illumination&, Warnings&) const override {}

 private:
  gl::BufferTexture values_;  ///< [vertex][number]
};

/// Encoded light of a light map's texels, as a map of layers that hold three numbers each.
LightMap asLightMap(const LightMap& map, const EncodedLight& light) {
  const std::size_t texels = map.layout.texelCount(), count = light.values.size() / texels,
                    layers = (count + 2) / 3;
  LightMap result;
  result.layout = map.layout;
  result.coefficients = static_cast<int>(layers);
  result.values.assign(3 * layers * texels, 0.0f);
  for (std::size_t texel = 0; texel < texels; ++texel)
    for (std::size_t i = 0; i < count; ++i)
      result.values[(3 * texel + i % 3) * layers + i / 3] = light.values[texel * count + i];
  return result;
}

}  // namespace

std::unique_ptr<DrawnTransfer> makeEncoded(Shading shading, const TechniqueInputs& of) {
  const RenderInputs& inputs = of.inputs;
  if (inputs.encoding == nullptr || inputs.bake == nullptr) return nullptr;
  const Ambient rule = infoOf(shading).encoded;
  const EncodedLight* light = encodedFor(rule, *inputs.bake, inputs.encoding->name);
  if (light == nullptr) return nullptr;
  if (rule == Ambient::EncodedVertices) return std::make_unique<EncodedVertexLighting>(*light);
  return std::make_unique<LightMapLighting>(asLightMap(*inputs.bake->lightMap, *light), inputs.compiled);
}

}  // namespace prelight::viewer

#include "viewer/techniques/encoded_light/encoded_lighting.h"

#include <algorithm>

namespace prelight::viewer {

EncodedVertexLighting::EncodedVertexLighting(const EncodedLight& light)
    : values_(gl::makeBufferTexture(std::span<const float>(light.values), 1, GL_R32F, "encoded light")) {}

void EncodedVertexLighting::bind(const gl::Program&) const {
  gl::bind(encodedVerticesUnit, GL_TEXTURE_BUFFER, values_.texture);
}

LightMap layersOf(const LightMap& map, const EncodedLight& light) {
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

const EncodedLight* findEncoded(const std::vector<EncodedLight>& lights, std::string_view encoding) {
  const auto found = std::ranges::find(lights, encoding, &EncodedLight::encoding);
  return found == lights.end() ? nullptr : &*found;
}

}  // namespace prelight::viewer

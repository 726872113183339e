#include "techniques/encoded_light/held_encodings.h"

#include <algorithm>

#include "encodings/registry/registry.h"
#include "techniques/bake_fit.h"
#include "techniques/shading.h"

namespace prelight {
namespace {

/// Light in encodings, at as many places.
void requireEncoded(const char* what, const std::vector<EncodedLight>& lights, std::size_t places) {
  for (const EncodedLight& light : lights)
    if (const Encoding* encoding = encodingNamed(light.encoding))
      requireCount(what, light.values.size(), places * encoding->values);
}

void checkEncoded(const Bake& bake, const CompiledScene& scene) {
  requireEncoded("encoded light of vertices", bake.encodedLight, scene.vertexCount());
  if (bake.lightMap)
    requireEncoded("encoded light of texels", bake.lightMap->encoded, bake.lightMap->layout.texelCount());
}

void takeEncoded(Bake& into, Bake& from) {
  if (!from.encodedLight.empty()) into.encodedLight = std::move(from.encodedLight);
}

}  // namespace

const std::vector<EncodedLight>* encodedFor(Ambient rule, const Bake& bake) {
  if (rule == Ambient::EncodedVertices) return &bake.encodedLight;
  return rule == Ambient::EncodedMap && bake.lightMap ? &bake.lightMap->encoded : nullptr;
}

const EncodedLight* encodedFor(Ambient rule, const Bake& bake, std::string_view encoding) {
  const std::vector<EncodedLight>* lights = encodedFor(rule, bake);
  if (lights == nullptr) return nullptr;
  const auto found = std::ranges::find(*lights, encoding, &EncodedLight::encoding);
  return found == lights->end() ? nullptr : &*found;
}

/// It comes with a light map.
extern const BakedPart encodingPart = {
    .addTo =
        [](BakeRequest& request, const BakeRequest& asked) {
          if (request.lightMap) request.encodedLight = asked.encodedLight;
        },
    .check = checkEncoded,
    .take = takeEncoded,
};

}  // namespace prelight

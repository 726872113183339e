#include "scene/light_hash.h"

#include "scene/light_profile.h"

namespace prelight {

void addLight(const Light& light, StateHash& hash) {
  hash.value(light.type).value(light.range);
  hash.value(light.innerConeAngle).value(light.outerConeAngle);
  for (int c = 0; c < 3; ++c)
    hash.value(light.intensity[c]).value(light.position[c]).value(light.direction[c]);
  if (light.profile != nullptr) addProfile(light, hash);
}

}  // namespace prelight

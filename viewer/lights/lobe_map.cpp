#include "viewer/lights/lobe_map.h"

#include <cmath>

#include "basis/sky_lobes.h"

namespace prelight::viewer {

LobeMap makeLobeMap(const Environment& sky) {
  const SkyLobes lobes(sky);
  LobeMap map;
  for (int lobe = 0; lobe < LobeMap::lobes; ++lobe) {
    const double spread = std::ldexp(1.0 / 3.0, lobe + 1 - LobeMap::lobes);
    const Environment part = lobes.map(alphaOfSpread(spread), LobeMap::width >> (lobe / 2));
    if (lobe % 2 == 0) map.levels.emplace_back();
    map.levels.back().insert(map.levels.back().end(), part.radiance.begin(), part.radiance.end());
  }
  return map;
}

}  // namespace prelight::viewer

// What lies between surfaces: the inside of solid glass absorbs light by Beer's law, all else lets it pass.
#ifndef PRELIGHT_TRANSPORT_MEDIUM_FUNCS_CL
#define PRELIGHT_TRANSPORT_MEDIUM_FUNCS_CL

#include "transport/bsdf_funcs.cl"

// Material that a ray has run through which a path believes to run through `medium`: what arrives at the back of solid glass
// has come through it, also when it started inside.
PRELIGHT_INLINE uint mediumBefore(Interaction i, uint medium) { return !i.front && isSolid(i) ? i.material : medium; }

// What a path that ran through `medium` runs through after a sample.
PRELIGHT_INLINE uint mediumAfter(Interaction i, uint lobe, uint medium) {
  if (lobe != PRELIGHT_LOBE_GLASS_TRANSMISSION || !isSolid(i)) return medium;
  return i.front ? i.material : PRELIGHT_NO_MEDIUM;
}

// Share of the light that is left after so many metres of a material.
PRELIGHT_INLINE float3 transmittance(PathScene s, uint medium, float distance) {
  return exp(-vload3(0, s.materials[medium].absorption) * distance);
}

#endif

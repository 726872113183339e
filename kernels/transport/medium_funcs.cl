// What lies between surfaces: the inside of what is solid absorbs light by Beer's law, or scatters it
// (transport/walk_funcs.cl), all else lets it pass.
// Options: PRELIGHT_MEDIA (some body scatters light within).
#ifndef PRELIGHT_TRANSPORT_MEDIUM_FUNCS_CL
#define PRELIGHT_TRANSPORT_MEDIUM_FUNCS_CL

#include "transport/bsdf_funcs.cl"

// Material that a ray has run through which a path believes to run through `medium`: what arrives at the back of something solid
// has come through it, also when it started inside.
PRELIGHT_INLINE uint mediumBefore(Interaction i, uint medium) { return !i.front && isSolid(i) ? i.material : medium; }

// What lies on the other side of a surface that ends `medium` or begins it.
PRELIGHT_INLINE uint mediumBeyond(Interaction i, uint medium) {
  if (!isSolid(i)) return medium;
  return i.front ? i.material : PRELIGHT_NO_MEDIUM;
}

// What a path that ran through `medium` runs through after a sample.
PRELIGHT_INLINE uint mediumAfter(Interaction i, uint lobe, uint medium) {
  return lobe == PRELIGHT_LOBE_GLASS_TRANSMISSION || lobe == PRELIGHT_LOBE_THROUGH ? mediumBeyond(i, medium) : medium;
}

// The same towards a direction.
PRELIGHT_INLINE uint mediumTowards(Interaction i, float3 direction, uint medium) {
  return dot(direction, i.geometric) < 0.0f ? mediumBeyond(i, medium) : medium;
}

// Whether a material's inside scatters light: what it absorbs counts on the walk there.
PRELIGHT_INLINE bool scattersWithin(PathScene s, uint medium) {
#ifdef PRELIGHT_MEDIA
  return medium != PRELIGHT_NO_MEDIUM && largest(vload3(0, s.materials[medium].scattering)) > 0.0f;
#else
  return false;
#endif
}

// Whether light on its way through a material is only absorbed there.
PRELIGHT_INLINE bool absorbsOnly(PathScene s, uint medium) {
  return medium != PRELIGHT_NO_MEDIUM && !scattersWithin(s, medium);
}

// Share of the light that is left after so many metres of a material where its scattering is left out: for what does not walk.
PRELIGHT_INLINE float3 unabsorbed(PathScene s, uint medium, float distance) {
  __global const ShadeMaterial* m = s.materials + medium;
  return exp(-vload3(0, m->absorption) * (1.0f - vload3(0, m->scattering)) * distance);
}

// Share of the light that is left after so many metres of a material, neither absorbed nor scattered.
PRELIGHT_INLINE float3 transmittance(PathScene s, uint medium, float distance) {
  return exp(-vload3(0, s.materials[medium].absorption) * distance);
}

#endif

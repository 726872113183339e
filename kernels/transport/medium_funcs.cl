// Media between surfaces: the inside of a solid absorbs light by Beer's law or scatters it (transport/walk_funcs.cl);
// everything else lets light pass.
// Options: PRELIGHT_MEDIA (some body scatters light within).
#ifndef PRELIGHT_TRANSPORT_MEDIUM_FUNCS_CL
#define PRELIGHT_TRANSPORT_MEDIUM_FUNCS_CL

#include "transport/bsdf_funcs.cl"

// Returns the material through which a ray has run when its path assumes `medium`: light that arrives at the back of a
// solid has come through it, even if the path started inside.
PRELIGHT_INLINE uint mediumBefore(Interaction i, uint medium) { return !i.front && isSolid(i) ? i.material : medium; }

// Returns the medium on the other side of a surface that ends or begins `medium`.
PRELIGHT_INLINE uint mediumBeyond(Interaction i, uint medium) {
  if (!isSolid(i)) return medium;
  return i.front ? i.material : PRELIGHT_NO_MEDIUM;
}

// Returns the medium of a path that ran through `medium` after a sample.
PRELIGHT_INLINE uint mediumAfter(Interaction i, uint lobe, uint medium) {
  return lobe == PRELIGHT_LOBE_GLASS_TRANSMISSION || lobe == PRELIGHT_LOBE_THROUGH ? mediumBeyond(i, medium) : medium;
}

// Returns the medium in a direction from the surface.
PRELIGHT_INLINE uint mediumTowards(Interaction i, float3 direction, uint medium) {
  return dot(direction, i.geometric) < 0.0f ? mediumBeyond(i, medium) : medium;
}

// Returns true when a material's inside scatters light; its absorption is then applied by the walk.
PRELIGHT_INLINE bool scattersWithin(PathScene s, uint medium) {
#ifdef PRELIGHT_MEDIA
  return medium != PRELIGHT_NO_MEDIUM && largest(vload3(0, s.materials[medium].scattering)) > 0.0f;
#else
  return false;
#endif
}

// Returns true when light that runs through a material is only absorbed there.
PRELIGHT_INLINE bool absorbsOnly(PathScene s, uint medium) {
  return medium != PRELIGHT_NO_MEDIUM && !scattersWithin(s, medium);
}

// Returns the share of light that is left after so many metres of a material when scattering is ignored, for rays that
// do not walk.
PRELIGHT_INLINE float3 unabsorbed(PathScene s, uint medium, float distance) {
  __global const ShadeMaterial* m = s.materials + medium;
  return exp(-vload3(0, m->absorption) * (1.0f - vload3(0, m->scattering)) * distance);
}

// Returns the share of light that is neither absorbed nor scattered in so many metres of a material.
PRELIGHT_INLINE float3 transmittance(PathScene s, uint medium, float distance) {
  return exp(-vload3(0, s.materials[medium].absorption) * distance);
}

#endif

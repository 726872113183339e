// Glass that refracts by wavelength (KHR_materials_dispersion). A path has one wavelength, drawn uniformly. It takes
// the colour of that wavelength when it first passes such glass, is reflected inside it or meets rough glass. Colours
// have a mean of 1 over all wavelengths in each channel.
// Options: PRELIGHT_DISPERSION.
#ifndef PRELIGHT_TRANSPORT_DISPERSION_FUNCS_CL
#define PRELIGHT_TRANSPORT_DISPERSION_FUNCS_CL

#include "core/wave_funcs.cl"
#include "transport/material_funcs.cl"

#ifdef PRELIGHT_DISPERSION
// Coordinate pair of the wavelength's random number, beyond those of all surfaces.
#define PRELIGHT_PAIR_WAVELENGTH 0x10000u

// Returns true when reflection and transmission both disperse, as in rough glass. Smooth glass disperses only light
// that enters: what it reflects outside has no colour.
PRELIGHT_INLINE bool splitsAsAWhole(Bsdf b) {
#ifdef PRELIGHT_ROUGH_GLASS
  return isRoughGlass(b);
#else
  return false;
#endif
}

// Sets the BSDF of a surface for a path of this wavelength. `chance`: position of the wavelength; dispersed: the path
// has its colour already.
PRELIGHT_INLINE void disperse(PathScene s, Interaction i, float chance, bool dispersed, Bsdf* b) {
  const float dispersion = s.materials[i.material].dispersion;
  if (!(dispersion > 0.0f)) return;
  b->bentIor = iorOfWave(b->ior, dispersion, chance);
  if (dispersed || !i.front || splitsAsAWhole(*b)) b->ior = b->bentIor;
#ifdef PRELIGHT_ROUGH_GLASS
  b->eta = relativeIor(*b, b->solid, i.front);
#endif
}

// Returns true when a path that has no colour yet takes that of its wavelength as it goes on by a lobe of a surface.
PRELIGHT_INLINE bool takesColor(PathScene s, Interaction i, Bsdf b, uint lobe) {
  if (!(s.materials[i.material].dispersion > 0.0f)) return false;
  if (splitsAsAWhole(b)) return true;
  return lobe == PRELIGHT_LOBE_GLASS_TRANSMISSION || (!i.front && lobe == PRELIGHT_LOBE_GLASS_REFLECTION);
}
#endif

#endif

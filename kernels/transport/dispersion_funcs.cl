// Glass that refracts by wavelength (KHR_materials_dispersion). A path has one wavelength, drawn evenly; where it first
// passes such glass, is reflected inside it or meets rough glass, it takes the colour of that. Colours have a mean of 1 over all wavelengths, in each channel.
// Options: PRELIGHT_DISPERSION.
#ifndef PRELIGHT_TRANSPORT_DISPERSION_FUNCS_CL
#define PRELIGHT_TRANSPORT_DISPERSION_FUNCS_CL

#include "core/wave_funcs.cl"
#include "transport/material_funcs.cl"

#ifdef PRELIGHT_DISPERSION
#define PRELIGHT_PAIR_WAVELENGTH 0x10000u  // of random numbers, beyond those of all surfaces

// Smooth glass takes a path apart where it is entered alone: what it reflects there has no colour.
PRELIGHT_INLINE bool splitsAsAWhole(Bsdf b) {
#ifdef PRELIGHT_ROUGH_GLASS
  return isRoughGlass(b);
#else
  return false;
#endif
}

// What a surface is to a path of this wavelength. dispersed: the path has its colour.
PRELIGHT_INLINE void disperse(PathScene s, Interaction i, float chance, bool dispersed, Bsdf* b) {
  const float dispersion = s.materials[i.material].dispersion;
  if (!(dispersion > 0.0f)) return;
  b->bentIor = iorOfWave(b->ior, dispersion, chance);
  if (dispersed || !i.front || splitsAsAWhole(*b)) b->ior = b->bentIor;
#ifdef PRELIGHT_ROUGH_GLASS
  b->eta = relativeIor(*b, b->solid, i.front);
#endif
}

// Whether a path that has no colour yet takes that of its wavelength as it goes on by a lobe of a surface.
PRELIGHT_INLINE bool takesColor(PathScene s, Interaction i, Bsdf b, uint lobe) {
  if (!(s.materials[i.material].dispersion > 0.0f)) return false;
  if (splitsAsAWhole(b)) return true;
  return lobe == PRELIGHT_LOBE_GLASS_TRANSMISSION || (!i.front && lobe == PRELIGHT_LOBE_GLASS_REFLECTION);
}
#endif

#endif

// Glass that refracts by wavelength (KHR_materials_dispersion). A path has one wavelength, drawn evenly; where it first
// passes such glass, is reflected inside it or meets rough glass, it takes the colour of that. Colours have a mean of 1 over all wavelengths, in each channel.
// Options: PRELIGHT_DISPERSION.
#ifndef PRELIGHT_TRANSPORT_DISPERSION_FUNCS_CL
#define PRELIGHT_TRANSPORT_DISPERSION_FUNCS_CL

#include "transport/material_funcs.cl"

#ifdef PRELIGHT_DISPERSION
#define PRELIGHT_SHORTEST_WAVE 430.0f  // nm; blue alone
#define PRELIGHT_LONGEST_WAVE 670.0f   // red alone
#define PRELIGHT_PAIR_WAVELENGTH 0x10000u  // of random numbers, beyond those of all surfaces

// Blue in one half, red in the other, green between them. chance: in [0,1), of the wavelength.
PRELIGHT_INLINE float3 colorOfWave(float chance) {
  const float x = 2.0f * chance - 1.0f;
  return (float3)(4.0f * fmax(x, 0.0f), 2.0f - 2.0f * fabs(x), 4.0f * fmax(-x, 0.0f));
}

// Cauchy's equation with Abbe's number 20 / dispersion; ior: that at 587.6 nm.
PRELIGHT_INLINE float iorOfWave(float ior, float dispersion, float chance) {
  const float wave = mix(PRELIGHT_SHORTEST_WAVE, PRELIGHT_LONGEST_WAVE, chance);
  return fmax(ior + (ior - 1.0f) * dispersion * 0.05f * (523655.0f / (wave * wave) - 1.5168f), 1.0f);
}

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

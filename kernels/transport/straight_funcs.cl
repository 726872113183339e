// Panes: thin glass without roughness, through which light goes straight on. Such light counts as direct light: shadow
// rays carry it along, and light that has passed a pane has not been scattered.
// Options: those of transport/material_funcs.cl, PRELIGHT_PANES (some surface is such glass; needs PRELIGHT_GLASS).
#ifndef PRELIGHT_TRANSPORT_STRAIGHT_FUNCS_CL
#define PRELIGHT_TRANSPORT_STRAIGHT_FUNCS_CL

#include "transport/bsdf_funcs.cl"

#ifdef PRELIGHT_PANES
PRELIGHT_INLINE bool isPane(Interaction i, Bsdf b) {
#ifdef PRELIGHT_ROUGH_GLASS
  if (isRoughGlass(b)) return false;
#endif
  return b.glass > 0.0f && !isSolid(i);
}

// Returns the share of the radiance from behind a pane that leaves along i.wo: the mean of what sampleBsdf passes
// straight on.
PRELIGHT_INLINE float3 paneTransmittance(Interaction i, Bsdf b) {
  const GlassWays ways = glassWays(b, false, i.front, i.wo, i.frame.z, i.geometric);
  float3 share = b.tint * (b.glass * (ways.passed + ways.passedFlat));
#ifdef PRELIGHT_LAYERS
  share *= leftByLayers(b, i.woLocal);
#endif
  return share;
}
#endif

// Returns true when a path that goes on from a surface by a lobe has only passed a pane.
PRELIGHT_INLINE bool goesStraight(Interaction i, Bsdf b, uint lobe) {
#ifdef PRELIGHT_PANES
  return lobe == PRELIGHT_LOBE_GLASS_TRANSMISSION && isPane(i, b);
#else
  return false;
#endif
}

#endif

// Which lobes make caustics.
#ifndef PRELIGHT_SHADE_LOBE_CLASS_FUNCS_CL
#define PRELIGHT_SHADE_LOBE_CLASS_FUNCS_CL

#include "shade/bsdf_funcs.cl"

#define PRELIGHT_NARROW_ALPHA 0.0625f  // roughness 0.25: host/photon/casters.h says the same

// Mirrors, and lobes that show what is there: light that they gather is followed from its source, light of wider ones is
// found by chance.
bool isNarrow(Bsdf b) { return b.smooth || b.alpha <= PRELIGHT_NARROW_ALPHA; }

#endif

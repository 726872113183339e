// Radiance that a surface scatters diffusely of known irradiance.
#ifndef PRELIGHT_TRANSPORT_IRRADIANCE_FUNCS_CL
#define PRELIGHT_TRANSPORT_IRRADIANCE_FUNCS_CL

#include "transport/layer_funcs.cl"

// What coat and sheen leave of the light that goes to an eye in a direction of this cosine.
PRELIGHT_INLINE float leftOfIrradiance(Bsdf b, float cosine) {
#ifdef PRELIGHT_LAYERS
  return belowLayers(b, cosine, cosine);
#else
  return 1.0f;
#endif
}

// W/(m2 sr) towards an eye. evalLobes' diffuse part with the layer's passage averaged over the
// directions that the light comes from.
PRELIGHT_INLINE float3 reflectIrradiance(Bsdf b, float3 eye, float3 irradiance) {
  return b.diffuse * irradiance * (PRELIGHT_INVERSE_PI * passage(b, eye) * leftOfIrradiance(b, eye.z));
}

#ifdef PRELIGHT_TRANSLUCENT
// The same of what comes through from the other side, where the irradiance is `irradiance`. Leaves and lampshades are lit by a
// sun or a lamp as often as by a sky: the passage halfway between that of perpendicular light and that of light from all
// sides errs by 2.5 % at most for either, of a layer of f0 0.04.
PRELIGHT_INLINE float3 transmitIrradiance(Bsdf b, float3 eye, float3 irradiance) {
  const float enters = 0.5f * (1.0f + passage(b, (float3)(0.0f, 0.0f, 1.0f)) * b.bodyGain);
  return b.transmitted * irradiance * (PRELIGHT_INVERSE_PI * passage(b, eye) * enters * leftOfIrradiance(b, eye.z));
}
#endif

#endif

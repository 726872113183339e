// Radiance of diffuse scattering for a given irradiance.
#ifndef PRELIGHT_TRANSPORT_IRRADIANCE_FUNCS_CL
#define PRELIGHT_TRANSPORT_IRRADIANCE_FUNCS_CL

#include "transport/layer_funcs.cl"

// Returns the share that coat and sheen leave of the light that goes to an eye in a direction of this cosine.
PRELIGHT_INLINE float leftOfIrradiance(Bsdf b, float cosine) {
#ifdef PRELIGHT_LAYERS
  return belowLayers(b, cosine, cosine);
#else
  return 1.0f;
#endif
}

// Returns the reflected radiance, W/(m2 sr), towards an eye: evalLobes' diffuse part with the layer's passage averaged
// over the directions from which the light comes.
PRELIGHT_INLINE float3 reflectIrradiance(Bsdf b, float3 eye, float3 irradiance) {
  return b.diffuse * irradiance * (PRELIGHT_INVERSE_PI * passage(b, eye) * leftOfIrradiance(b, eye.z));
}

#ifdef PRELIGHT_TRANSLUCENT
// Returns the radiance of light that comes through from the other side, where the irradiance is `irradiance`. Leaves
// and lampshades are lit by a sun or a lamp as often as by a sky: the passage halfway between that of perpendicular
// light and that of light from all sides errs by 2.5 % at most for either, for a layer of f0 0.04.
PRELIGHT_INLINE float3 transmitIrradiance(Bsdf b, float3 eye, float3 irradiance) {
  const float enters = 0.5f * (1.0f + passage(b, (float3)(0.0f, 0.0f, 1.0f)) * b.bodyGain);
  return b.transmitted * irradiance * (PRELIGHT_INVERSE_PI * passage(b, eye) * enters * leftOfIrradiance(b, eye.z));
}
#endif

#endif

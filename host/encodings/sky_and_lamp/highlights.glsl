#include "harmonic_sky.glsl"
#include "sky_and_lamp.glsl"

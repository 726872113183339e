// Light of a place by direction, as baked_lobes.glsl asks for it.
const int bakedLampCount = encodedLampCount;

vec3 bakedLamp(Visibility seen, int i, out vec3 toLamp) { return encodedLamp(seen.light.values, seen.light.frame, i, toLamp); }

vec3 bakedInLobe(Visibility seen, vec3 axis, float spread) { return encodedRadiance(seen.light.values, seen.light.frame, axis, spread); }

vec3 bakedIrradiance(Visibility seen, vec3 n) { return irradianceOfEncoded(seen.light, n); }

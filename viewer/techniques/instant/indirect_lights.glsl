// Irradiance that other surfaces send, of virtual lights. n, geometric: on the side that is asked about.
#include "virtual_lights.glsl"

vec3 indirectIrradiance(int triangle, bool front, vec3 n, vec3 geometric) { return virtualIrradiance(vPosition, n, geometric); }
